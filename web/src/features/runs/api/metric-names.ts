/** What runs have logged: each can be a column. */
import { queryOptions } from '@tanstack/react-query';
import { client, unwrap } from '@/lib/api';

export const metricNamesQuery = queryOptions({
  queryKey: ['metric-names'],
  queryFn: ({ signal }) => unwrap(client.GET('/api/metric-names', { signal })),
});
