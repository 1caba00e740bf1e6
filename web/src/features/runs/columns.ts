/** The columns that every run has, whatever it logs, as data. */

export interface Column {
  readonly name: string;
  /** Width as long as there is room for all [px]. */
  readonly width: number;
  readonly isNumber?: boolean;
  readonly help?: string;
  readonly isSortable?: boolean;
  readonly isLargestFirst?: boolean;
}

/** By key, in the order of the table. The server sorts by the same keys. */
const COLUMNS = {
  state: { name: 'State', width: 104, isSortable: true },
  task: { name: 'Task', width: 150, isSortable: true },
  phase: { name: 'Phase', width: 98, isSortable: true },
  method: { name: 'Method', width: 84, isSortable: true },
  seed: { name: 'Seed', width: 58, isNumber: true, isSortable: true },
  preset: { name: 'Preset', width: 68, isSortable: true },
  tags: { name: 'Tags', width: 130, help: 'What people call it; a click narrows the table to a tag' },
  progress: { name: 'Progress', width: 140, isSortable: true, isLargestFirst: true, help: 'Epoch it is in, of all' },
  success: {
    name: 'Success',
    width: 104,
    isNumber: true,
    isSortable: true,
    isLargestFirst: true,
    help: 'Success of the newest test, and the best of all tests',
  },
  speed: {
    name: 'Speed',
    width: 96,
    isNumber: true,
    isSortable: true,
    isLargestFirst: true,
    help: 'Environment steps per second, and gradient updates per second',
  },
  left: { name: 'Time left', width: 82, isNumber: true, isSortable: true },
  duration: { name: 'Duration', width: 82, isNumber: true, isSortable: true, isLargestFirst: true },
  launched: { name: 'Launched', width: 94, isNumber: true, isSortable: true, isLargestFirst: true },
} satisfies Record<string, Column>;

export type BuiltIn = keyof typeof COLUMNS;

export const BUILT_INS: Readonly<Record<BuiltIn, Column>> = COLUMNS;

export const BUILT_IN_KEYS = Object.keys(COLUMNS) as readonly BuiltIn[];

export function isBuiltIn(key: string): key is BuiltIn {
  return Object.hasOwn(BUILT_INS, key);
}

/** The columns that are shown; which run it is, is always. */
export function shownColumns(hidden: readonly BuiltIn[] = []): readonly BuiltIn[] {
  return BUILT_IN_KEYS.filter((key) => key === 'task' || !hidden.includes(key));
}

/** Width of a metric's column [px]. */
export const METRIC_WIDTH = 108;
