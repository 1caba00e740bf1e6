/** The keys that drive a 3D view, wherever the focus is on the page. */
import type { SceneCommand, TransportState } from '@/lib/scene-control';

/** Steps that an arrow key goes with Shift. */
const LEAP = 10;

/** What the keys do, for those who cannot see it. */
export const KEYS_HELP = 'Space plays and pauses, left and right arrow step (with Shift by ten), Home and End jump.';

/** What a key asks for, if anything. */
export function readTransportKey(key: string, isShifted: boolean, state: TransportState): SceneCommand | undefined {
  const by = isShifted ? LEAP : 1;
  switch (key) {
    case ' ':
      return { do: 'toggle' };
    case 'ArrowLeft':
      return { do: 'step', by: -Math.min(by, state.steps) };
    case 'ArrowRight':
      return { do: 'step', by: Math.min(by, state.steps) };
    case 'Home':
      return { do: 'seek', step: 0 };
    case 'End':
      return { do: 'seek', step: state.steps };
    default:
      return undefined;
  }
}

/** Whether what has the focus needs the key for itself. */
export function needsKey(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof Element)) return false;
  if (
    target.closest(
      // What can be focused without being a field is scrolled by the keys, or moved.
      'textarea, select, [contenteditable], [role=tablist], [role=menu], [role=listbox], [role=dialog], dialog, [tabindex="0"]',
    )
  ) {
    return true;
  }
  const input = target.closest('input');
  if (input !== null) return input.type !== 'range' || key !== ' ';
  return key === ' ' && target.closest('button, a, summary') !== null;
}
