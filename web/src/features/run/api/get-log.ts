/** The end of a run's log; each poll asks only for what was written since the last. */
import { type QueryClient, queryOptions } from '@tanstack/react-query';
import type { LogTail } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';
import { POLL_MS } from '@/lib/queries';

/** Of a long log, this much is kept on the page [characters]. */
const MOST_TEXT = 500_000;

const ENDED_POLL_MS = 20_000; // [ms]

export function logQuery(queries: QueryClient, runId: string, isLive: boolean) {
  const queryKey = ['runs', 'log', runId] as const;
  return queryOptions({
    queryKey,
    queryFn: async ({ signal }): Promise<LogTail> => {
      const known = queries.getQueryData<LogTail>(queryKey);
      const params = { path: { run_id: runId }, query: { after: known?.offset } };
      const tail = await unwrap(client.GET('/api/runs/{run_id}/log', { params, signal }));
      return { offset: tail.offset, text: `${known?.text ?? ''}${tail.text}`.slice(-MOST_TEXT) };
    },
    refetchInterval: isLive ? POLL_MS : ENDED_POLL_MS,
    structuralSharing: false,
  });
}
