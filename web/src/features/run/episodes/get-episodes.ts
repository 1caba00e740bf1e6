/** The recorded episodes of a run, and what happened in one of them. */
import { infiniteQueryOptions, keepPreviousData, queryOptions } from '@tanstack/react-query';
import { client, unwrap } from '@/lib/api';
import { SLOW_POLL_MS } from '@/lib/queries';
import { reconnecting } from '@/lib/reconnecting';
import type { EpisodePlace, EpisodeSorting } from './place';
import type { Tag } from './tags';

/** Rows that a press on "more" adds. */
const PAGE_ROWS = 50;

interface Wanted extends EpisodeSorting {
  readonly tag?: Tag;
  readonly epoch?: number;
}

export function episodesQuery(runId: string, wanted: Wanted, isLive: boolean) {
  return infiniteQueryOptions({
    queryKey: ['runs', 'episodes', runId, wanted],
    queryFn: ({ pageParam, signal }) => {
      const query = { ...wanted, limit: PAGE_ROWS, offset: pageParam };
      return unwrap(client.GET('/api/runs/{run_id}/episodes', { params: { path: { run_id: runId }, query }, signal }));
    },
    initialPageParam: 0,
    getNextPageParam: ({ total }, pages) => {
      const shown = pages.reduce((sum, page) => sum + page.episodes.length, 0);
      return shown < total ? shown : undefined;
    },
    refetchInterval: isLive ? SLOW_POLL_MS : reconnecting,
    placeholderData: keepPreviousData,
  });
}

export function timelinesQuery(runId: string, { epoch, index }: EpisodePlace) {
  return queryOptions({
    queryKey: ['runs', 'episode', runId, epoch, index],
    queryFn: ({ signal }) =>
      unwrap(
        client.GET('/api/runs/{run_id}/episodes/{epoch}/{index}', {
          params: { path: { run_id: runId, epoch, index } },
          signal,
        }),
      ),
    staleTime: Number.POSITIVE_INFINITY,
  });
}
