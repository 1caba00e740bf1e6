/** The curves of a run, also what later attempts replaced; each poll asks only for what came since the last. */
import { type QueryClient, queryOptions } from '@tanstack/react-query';
import { client, unwrap } from '@/lib/api';
import { type Metrics, mergeMetrics, NO_METRICS } from '@/lib/metrics';
import { POLL_MS } from '@/lib/queries';

/** How often an ended run is asked for late points [ms]. */
const ENDED_POLL_MS = 20_000;

/** An answer at least this long may have been cut, so more is asked for at once. */
const FULL_ANSWER = 500;

export function metricsQuery(queries: QueryClient, runId: string, isLive: boolean) {
  const queryKey = ['runs', 'metrics', runId] as const;
  return queryOptions({
    queryKey,
    queryFn: async ({ signal }) => {
      let known = queries.getQueryData<Metrics>(queryKey) ?? NO_METRICS;
      for (;;) {
        const params = { path: { run_id: runId }, query: { after: known.cursor, superseded: true } };
        const batch = await unwrap(client.GET('/api/runs/{run_id}/metrics', { params, signal }));
        known = mergeMetrics(known, batch);
        if (batch.step.length < FULL_ANSWER) return known;
      }
    },
    refetchInterval: isLive ? POLL_MS : ENDED_POLL_MS,
    structuralSharing: false,
  });
}
