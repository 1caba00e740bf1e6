/** The rows of the runs table, kept fresh. */
import { infiniteQueryOptions, keepPreviousData } from '@tanstack/react-query';
import { client, unwrap } from '@/lib/api';
import { POLL_MS } from '@/lib/queries';
import { type RunsSearch, sortingOf } from '../search';

/** Rows asked for at once. */
const PAGE_SIZE = 50;

export function listRunsQuery(search: RunsSearch) {
  const { state, task, phase, method, search: words } = search;
  const wanted = { state, task, phase, method, search: words, deleted: search.deleted === 'yes' };
  return infiniteQueryOptions({
    queryKey: ['runs', 'list', search],
    queryFn: ({ pageParam, signal }) =>
      unwrap(
        client.GET('/api/runs', {
          params: { query: { ...wanted, ...sortingOf(search), limit: PAGE_SIZE, cursor: pageParam } },
          signal,
        }),
      ),
    initialPageParam: undefined as string | undefined,
    getNextPageParam: (page) => page.next_cursor ?? undefined,
    refetchInterval: POLL_MS,
    placeholderData: keepPreviousData,
  });
}
