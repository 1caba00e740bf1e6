/** The runs table's filters and order, as they stand in the address. */
import type { RunState } from '@/client/schema.gen';
import { RUN_STATES } from '@/lib/states';

/** What the runs can be sorted by, and whether that begins with the largest. */
export const SORT_KEYS = { launched: true, state: false, success: true, task: false } as const;
export type SortKey = keyof typeof SORT_KEYS;

/** What the runs table is narrowed to, and how it is sorted. */
export interface RunsSearch {
  readonly state?: RunState;
  readonly task?: string;
  readonly phase?: 'locomotion' | 'manipulation';
  readonly method?: string;
  readonly search?: string;
  /** Whether the deleted runs are shown, instead of all others. */
  readonly deleted?: 'yes';
  /** Left out: by launch. */
  readonly sort?: SortKey;
  /** Left out: as the key has it. */
  readonly order?: 'up' | 'down';
}

/** Read the filters from an address; what makes no sense is left out. */
export function readRunsSearch(raw: Record<string, unknown>): RunsSearch {
  const text = (key: string): string | undefined => {
    const value = raw[key];
    return value === undefined || value === null || value === '' ? undefined : String(value);
  };
  const phase = text('phase');
  const sort = text('sort');
  const order = text('order');
  return {
    state: RUN_STATES.find((state) => state === raw.state),
    task: text('task'),
    phase: phase === 'locomotion' || phase === 'manipulation' ? phase : undefined,
    method: text('method'),
    search: text('search')?.slice(0, 200),
    deleted: raw.deleted === 'yes' ? 'yes' : undefined,
    sort: sort !== undefined && sort in SORT_KEYS ? (sort as SortKey) : undefined,
    order: order === 'up' || order === 'down' ? order : undefined,
  };
}

/** How the runs are sorted. */
export interface Sorting {
  readonly sort: SortKey;
  readonly descending: boolean;
}

export function sortingOf({ sort = 'launched', order }: RunsSearch): Sorting {
  return { sort, descending: order === undefined ? SORT_KEYS[sort] : order === 'down' };
}

/** What to put into the address so that the runs are sorted so. */
export function searchOf({ sort, descending }: Sorting): RunsSearch {
  return {
    sort: sort === 'launched' ? undefined : sort,
    order: descending === SORT_KEYS[sort] ? undefined : descending ? 'down' : 'up',
  };
}

/** Whether anything is left out of the table. */
export function isNarrowed({ state, task, phase, method, search }: RunsSearch): boolean {
  return [state, task, phase, method, search].some((value) => value !== undefined);
}
