/** By what the configs of runs differ. */
import { queryOptions } from '@tanstack/react-query';
import { client, unwrap } from '@/lib/api';

export function configsQuery(runIds: readonly string[]) {
  return queryOptions({
    queryKey: ['compare', 'configs', runIds],
    queryFn: ({ signal }) =>
      unwrap(client.GET('/api/compare/configs', { params: { query: { run: [...runIds] } }, signal })),
    enabled: runIds.length > 0,
  });
}
