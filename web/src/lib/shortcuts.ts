/** Every shortcut of the page, for the list that `?` opens; and what keys that work everywhere ask for. */
import { ACCOUNT, PLACES, type PlacePath } from '@/lib/places';

export interface Shortcut {
  /** Keys of one press joined by `+`; presses one after the other apart; ways to the same apart in the list. */
  readonly keys: readonly string[];
  readonly does: string;
}

export interface ShortcutGroup {
  readonly title: string;
  readonly shortcuts: readonly Shortcut[];
}

/** The first key of a jump to a place. */
const JUMP = 'g';

export const SHORTCUTS: readonly ShortcutGroup[] = [
  {
    title: 'Everywhere',
    shortcuts: [
      { keys: ['Ctrl+K', '⌘+K'], does: 'Find a page, a run, a study or an action' },
      { keys: ['?'], does: 'Show this list' },
      ...[...PLACES, ACCOUNT].map(({ key, label }) => ({ keys: [`${JUMP} ${key}`], does: `Go to ${label}` })),
    ],
  },
  {
    title: 'Runs, with the focus on the box of a line',
    shortcuts: [
      { keys: ['↑', '↓'], does: 'Go to the line above or below' },
      { keys: ['Page Up', 'Page Down'], does: 'Go fifteen lines' },
      { keys: ['Home', 'End'], does: 'Go to the first or the last line' },
      { keys: ['Shift+↑', 'Shift+↓'], does: 'Select lines on the way' },
      { keys: ['Space'], does: 'Select the line' },
      { keys: ['Enter'], does: 'Open the run, or open and close the group' },
      { keys: ['←', '→'], does: 'Close or open the group' },
      { keys: ['Esc'], does: 'Select nothing' },
    ],
  },
  {
    title: '3D view',
    shortcuts: [
      { keys: ['Space'], does: 'Play and pause' },
      { keys: ['←', '→'], does: 'Go one step' },
      { keys: ['Shift+←', 'Shift+→'], does: 'Go ten steps' },
      { keys: ['Home', 'End'], does: 'Go to the first or the last step' },
    ],
  },
  {
    title: 'Charts, with the focus on one',
    shortcuts: [
      { keys: ['←', '→'], does: 'Go to the point before or after' },
      { keys: ['Home', 'End'], does: 'Go to the first or the last point' },
      { keys: ['+', '-'], does: 'Zoom in and out' },
      { keys: ['Shift+←', 'Shift+→'], does: 'Move the window' },
      { keys: ['0', 'Esc'], does: 'Show all' },
    ],
  },
  {
    title: 'Tests of a run, with the focus on their bars',
    shortcuts: [
      { keys: ['←', '→'], does: 'Go to the test before or after' },
      { keys: ['Home', 'End'], does: 'Go to the first or the last test' },
      { keys: ['Enter', 'Space'], does: 'Show the episodes of this test alone' },
      { keys: ['Esc'], does: 'Show the episodes of all tests' },
    ],
  },
  {
    title: 'Queue, with the focus in a row',
    shortcuts: [{ keys: ['Alt+↑', 'Alt+↓'], does: 'Move the run forward or back' }],
  },
];

/** What keys ask for that work everywhere. */
export type Wish = { readonly show: 'palette' | 'shortcuts' } | { readonly go: PlacePath };

export interface Press {
  readonly key: string;
  readonly ctrlKey: boolean;
  readonly metaKey: boolean;
  readonly altKey: boolean;
}

/** Read one press; `after` is the plain key pressed just before it, if any. */
export function readShortcut({ key, ctrlKey, metaKey, altKey }: Press, after: string | null): Wish | undefined {
  if (altKey) return undefined;
  if (ctrlKey || metaKey) return key.toLowerCase() === 'k' ? { show: 'palette' } : undefined;
  if (key === '?') return { show: 'shortcuts' };
  if (after !== JUMP) return undefined;
  const place = [...PLACES, ACCOUNT].find((candidate) => candidate.key === key);
  return place && { go: place.to };
}

/** Inputs in which nothing is typed. */
const WITHOUT_TEXT: readonly string[] = ['button', 'checkbox', 'radio', 'range', 'submit', 'reset', 'color', 'file'];

/** Whether keys go into a field, or into what lies above the page. */
export function takesKeys(target: EventTarget | null): boolean {
  if (!(target instanceof Element)) return false;
  if (target.closest('textarea, select, [contenteditable], [role=dialog], [role=menu], [role=listbox]')) return true;
  const input = target.closest('input');
  return input !== null && !WITHOUT_TEXT.includes(input.type);
}
