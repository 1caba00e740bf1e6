/** Other runs whose policies can start from the same start as a run's. */
import { queryOptions } from '@tanstack/react-query';
import type { RunDetail } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';

/** Runs to choose from at most. */
const MOST_RUNS = 50;

export function besideQuery({ id, task, phase }: RunDetail) {
  return queryOptions({
    queryKey: ['runs', 'beside', id],
    queryFn: async ({ signal }) => {
      const query = { task: [task], phase: [phase], limit: MOST_RUNS };
      const page = await unwrap(client.GET('/api/runs', { params: { query }, signal }));
      return page.runs.filter((run) => run.id !== id && run.started_at !== null);
    },
  });
}
