/** Groups of runs, and the runs of one group. */
import { keepPreviousData, queryOptions } from '@tanstack/react-query';
import type { RunGroup } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';
import { SLOW_POLL_MS } from '@/lib/queries';
import { filterOf, filterQuery, type GroupKey, type RunsFilter, type RunsSearch } from '../search';
import { groupSortingOf } from '../sorting';

/** The metric whose spread groups show unless another is chosen. */
export const USUAL_SPREAD = 'test/success_rate:last';

export function groupQuery(search: RunsSearch) {
  const by = [...(search.group ?? [])];
  return { ...filterQuery(filterOf(search)), ...groupSortingOf(search), by, metric: search.spread ?? USUAL_SPREAD };
}

/** All groups, kept fresh. */
export function groupsQuery(search: RunsSearch) {
  const query = groupQuery(search);
  return queryOptions({
    queryKey: ['runs', 'list', 'groups', query],
    queryFn: ({ signal }) => unwrap(client.GET('/api/run-groups', { params: { query }, signal })),
    refetchInterval: SLOW_POLL_MS,
    placeholderData: keepPreviousData,
    enabled: query.by.length > 0,
  });
}

/** What a group is called in the address. */
export function groupId(group: RunGroup, by: readonly GroupKey[]): string {
  return by.map((key) => group.keys[key] ?? '').join('|');
}

/** The table narrowed to one group. */
export function searchOfGroup(search: RunsSearch, group: RunGroup): RunsSearch {
  const { group: by = [], open, spread, ...rest } = search;
  const narrowing = Object.fromEntries(
    by.map((key) => [key, key === 'settings' ? group.keys[key] : [group.keys[key]]]),
  ) as RunsFilter;
  return { ...rest, ...narrowing };
}
