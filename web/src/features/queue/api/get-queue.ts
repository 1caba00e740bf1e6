/** The runs that have not ended, in the order in which they will start. */
import { queryOptions } from '@tanstack/react-query';
import { client, unwrap } from '@/lib/api';
import { POLL_MS } from '@/lib/queries';

export const queueQuery = queryOptions({
  queryKey: ['queue'],
  queryFn: ({ signal }) => unwrap(client.GET('/api/queue', { signal })),
  refetchInterval: POLL_MS,
});
