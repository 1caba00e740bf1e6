/** Give the focus back to what had it once something that took it has closed. */
import { useEffect } from 'react';

/**
 * For a dialog that is there only while it is open, or loaded when first opened: it cannot know what had the focus.
 * @param isOpen whether it is asked for, loaded or not
 */
export function useFocusBack(isOpen: boolean): void {
  useEffect(() => {
    if (!isOpen) return;
    const before = opener();
    return () => before?.focus({ preventScroll: true });
  }, [isOpen]);
}

/** What has the focus; of a menu, which goes with the press, the button that opened it. */
function opener(): HTMLElement | null {
  const active = document.activeElement;
  const menu = active?.closest('[role=menu]');
  const found = menu ? document.getElementById(menu.getAttribute('aria-labelledby') ?? '') : active;
  return found instanceof HTMLElement ? found : null;
}
