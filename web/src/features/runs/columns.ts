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
  state: { name: 'State', width: 106, isSortable: true },
  task: { name: 'Task', width: 174, isSortable: true },
  phase: { name: 'Phase', width: 98, isSortable: true },
  method: { name: 'Method', width: 86, isSortable: true },
  seed: { name: 'Seed', width: 46, isNumber: true, isSortable: true },
  preset: { name: 'Preset', width: 60, isSortable: true },
  changes: { name: 'Changes', width: 150, help: 'Settings in which it is not as its preset' },
  tags: { name: 'Tags', width: 72, help: 'What people call it; a click narrows the table to a tag' },
  progress: { name: 'Progress', width: 98, isSortable: true, isLargestFirst: true, help: 'Epoch it is in, of all' },
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
    width: 84,
    isNumber: true,
    isSortable: true,
    isLargestFirst: true,
    help: 'Environment steps per second, and gradient updates per second',
  },
  left: { name: 'Left', help: 'Time it will still take', width: 60, isNumber: true, isSortable: true },
  duration: { name: 'Duration', width: 68, isNumber: true, isSortable: true, isLargestFirst: true },
  launched: { name: 'Launched', width: 94, isNumber: true, isSortable: true, isLargestFirst: true },
} satisfies Record<string, Column>;

export type BuiltIn = keyof typeof COLUMNS;

export const BUILT_INS: Readonly<Record<BuiltIn, Column>> = COLUMNS;

export const BUILT_IN_KEYS = Object.keys(COLUMNS) as readonly BuiltIn[];

export function isBuiltIn(key: string): key is BuiltIn {
  return Object.hasOwn(BUILT_INS, key);
}

/** Shown unless others are chosen: all that fits on a small screen. */
export const USUAL_COLUMNS: readonly BuiltIn[] = BUILT_IN_KEYS.filter(
  (key) => key !== 'preset' && key !== 'changes' && key !== 'duration',
);

/** The columns that are shown; which run it is, is always. */
export function shownColumns(chosen: readonly BuiltIn[] = USUAL_COLUMNS): readonly BuiltIn[] {
  return BUILT_IN_KEYS.filter((key) => key === 'task' || chosen.includes(key));
}

/** Show one column more or less; undefined if that is what is shown without a word. */
export function withColumn(
  key: BuiltIn,
  isShown: boolean,
  chosen?: readonly BuiltIn[],
): readonly BuiltIn[] | undefined {
  const now = shownColumns(chosen);
  const next = BUILT_IN_KEYS.filter((one) => (one === key ? isShown : now.includes(one)));
  return next.join() === USUAL_COLUMNS.join() ? undefined : next;
}

/** Width of a metric's column [px]. */
export const METRIC_WIDTH = 112;
