/** What a launch would do, asked again whenever the form rests. */
import { keepPreviousData, queryOptions } from '@tanstack/react-query';
import type { Launch } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';

export function planQuery(launch: Launch | null) {
  return queryOptions({
    queryKey: ['plan', launch],
    queryFn: ({ signal }) => unwrap(client.POST('/api/launches/plan', { body: launch as Launch, signal })),
    enabled: launch !== null,
    placeholderData: keepPreviousData,
    // What can be reused changes as runs come and go.
    refetchInterval: 10_000,
  });
}
