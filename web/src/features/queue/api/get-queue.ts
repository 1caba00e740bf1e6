/** The first of the runs that have not ended, in the order in which they will start. */
import { keepPreviousData, queryOptions } from '@tanstack/react-query';
import { client, unwrap } from '@/lib/api';
import { POLL_MS, SLOW_POLL_MS } from '@/lib/queries';

/** From so many runs on, the server is asked less often. */
const LONG_QUEUE = 500;

/** What of the queue is known under any limit. */
export const QUEUE_KEY = ['queue'] as const;

export function queueQuery(limit: number) {
  return queryOptions({
    queryKey: [...QUEUE_KEY, limit],
    queryFn: ({ signal }) => unwrap(client.GET('/api/queue', { params: { query: { limit } }, signal })),
    refetchInterval: ({ state }) => ((state.data?.total ?? 0) < LONG_QUEUE ? POLL_MS : SLOW_POLL_MS),
    placeholderData: keepPreviousData,
  });
}
