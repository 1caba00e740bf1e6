/** Pages of the runs table, each fetched on its own, so that only what is looked at is kept fresh. */
import { keepPreviousData, queryOptions } from '@tanstack/react-query';
import type { RunPage } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';
import { POLL_MS } from '@/lib/queries';
import { filterOf, filterQuery, type RunsSearch } from '../search';
import { runSortingOf } from '../sorting';

/** Rows of a page. */
export const PAGE_SIZE = 50;

/** Rows that are asked for at once when all are wanted. */
const LARGE_PAGE = 200;

/** One page, kept fresh while it is looked at. */
export function runsPageQuery(search: RunsSearch, page: number) {
  const wanted = { filter: filterOf(search), sorting: runSortingOf(search), columns: search.columns };
  return queryOptions({
    queryKey: ['runs', 'list', wanted, page],
    queryFn: ({ signal }) => fetchRuns(search, page * PAGE_SIZE, PAGE_SIZE, signal),
    refetchInterval: POLL_MS,
    // While other filters are fetched, the old rows stay; a page further down has no old rows.
    placeholderData: page === 0 ? keepPreviousData : undefined,
  });
}

/** The runs from one row on, as they are now. */
export async function fetchRuns(
  search: RunsSearch,
  offset: number,
  limit: number,
  signal?: AbortSignal,
): Promise<RunPage> {
  const query = { ...filterQuery(filterOf(search)), ...runSortingOf(search), column: [...(search.columns ?? [])] };
  return unwrap(client.GET('/api/runs', { params: { query: { ...query, offset, limit } }, signal }));
}

/** The runs between two rows, both included. */
export async function fetchRowsBetween(search: RunsSearch, first: number, last: number): Promise<RunPage['runs']> {
  const starts = Array.from({ length: Math.ceil((last - first + 1) / LARGE_PAGE) }, (_, i) => first + i * LARGE_PAGE);
  const pages = await Promise.all(
    starts.map((start) => fetchRuns(search, start, Math.min(LARGE_PAGE, last - start + 1))),
  );
  return pages.flatMap((page) => page.runs);
}
