/** What is there on every page for whoever asks: the palette of commands and the list of shortcuts, loaded when opened. */
import { useNavigate } from '@tanstack/react-router';
import { lazy, Suspense, useEffect, useRef } from 'react';
import { readShortcut, takesKeys, type Wish } from '@/lib/shortcuts';
import { useFocusBack } from '@/lib/use-focus-back';

/** The second key of a jump comes this soon after the first [ms]. */
const CHORD_MS = 1_500;

const CommandPalette = lazy(() =>
  import('@/features/palette/command-palette').then((part) => ({ default: part.CommandPalette })),
);
const ShortcutsDialog = lazy(() =>
  import('@/features/shortcuts/shortcuts-dialog').then((part) => ({ default: part.ShortcutsDialog })),
);

export type Guide = 'palette' | 'shortcuts';

interface Props {
  shown: Guide | null;
  onShow: (guide: Guide | null) => void;
}

export function KeyboardGuide({ shown, onShow }: Props) {
  const navigate = useNavigate();
  useShortcuts((wish) => {
    if ('go' in wish) void navigate({ to: wish.go });
    else onShow(wish.show);
  });
  const close = (): void => onShow(null);
  useFocusBack(shown !== null);
  return (
    <Suspense fallback={null}>
      {shown === 'palette' && <CommandPalette onClose={close} onShowShortcuts={() => onShow('shortcuts')} />}
      {shown === 'shortcuts' && <ShortcutsDialog onClose={close} />}
    </Suspense>
  );
}

/** Listen to the keys of the whole page; in a field only the palette is asked for. */
function useShortcuts(onWish: (wish: Wish) => void): void {
  const answer = useRef(onWish);
  answer.current = onWish;
  useEffect(() => {
    let before: { key: string; at: number } | null = null;
    const press = (event: KeyboardEvent): void => {
      if (event.defaultPrevented || event.key === 'Shift') return;
      const after = before !== null && event.timeStamp - before.at < CHORD_MS ? before.key : null;
      const isPlain = !event.ctrlKey && !event.metaKey && !event.altKey;
      before = null;
      if (isPlain && takesKeys(event.target)) return;
      const wish = readShortcut(event, after);
      if (wish !== undefined) {
        event.preventDefault();
        answer.current(wish);
      } else if (isPlain) before = { key: event.key, at: event.timeStamp };
    };
    window.addEventListener('keydown', press);
    return () => window.removeEventListener('keydown', press);
  }, []);
}
