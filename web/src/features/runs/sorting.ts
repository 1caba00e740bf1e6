/** How the table is sorted: a click on a head sorts by it, another turns the order round. */
import { BUILT_INS, isBuiltIn } from './columns';
import { GROUP_KEYS, type RunsSearch } from './search';

export interface Sorting {
  readonly sort: string;
  readonly descending: boolean;
}

/** What only groups can be sorted by. */
const GROUP_SORTS = ['launched', 'runs', 'median', ...GROUP_KEYS] as const;
export type GroupSort = (typeof GROUP_SORTS)[number];

/** Words begin with A; numbers and moments with the largest, unless small ones are what is looked for. */
export function isLargestFirst(sort: string): boolean {
  if (isBuiltIn(sort)) return BUILT_INS[sort].isLargestFirst === true;
  return sort === 'runs' || sort === 'median' || sort.includes(':');
}

export function sortingOf({ sort = 'launched', order }: RunsSearch): Sorting {
  return { sort, descending: order === undefined ? isLargestFirst(sort) : order === 'down' };
}

/** The order of groups: what runs alone can be sorted by counts as no order. */
export function groupSortingOf(search: RunsSearch): { sort: GroupSort; descending: boolean } {
  const { sort, descending } = sortingOf(search);
  const known = GROUP_SORTS.find((key) => key === sort);
  return known === undefined ? { sort: 'launched', descending: true } : { sort: known, descending };
}

/** The order of runs: what groups alone can be sorted by counts as no order. */
export function runSortingOf(search: RunsSearch): Sorting {
  const sorting = sortingOf(search);
  const isSortable = sorting.sort.includes(':') || (isBuiltIn(sorting.sort) && BUILT_INS[sorting.sort].isSortable);
  return isSortable ? sorting : { sort: 'launched', descending: true };
}

/** What to put into the address so that the table is sorted so. */
export function searchOf({ sort, descending }: Sorting): Pick<RunsSearch, 'sort' | 'order'> {
  return {
    sort: sort === 'launched' ? undefined : sort,
    order: descending === isLargestFirst(sort) ? undefined : descending ? 'down' : 'up',
  };
}

/** What follows from a click on a head. */
export function turned(now: Sorting, sort: string): Sorting {
  return { sort, descending: now.sort === sort ? !now.descending : isLargestFirst(sort) };
}
