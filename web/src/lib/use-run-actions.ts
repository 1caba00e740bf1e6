/** Ask the server for something about runs; what shows them is fetched again. */
import { type QueryClient, useMutation, useQueryClient } from '@tanstack/react-query';
import { client, unwrap } from '@/lib/api';
import type { Action } from '@/lib/run-actions';

interface Wish {
  readonly action: Action;
  readonly runIds: readonly string[];
}

/** End, hold, release, retry, delete or restore runs. */
export function useRunActions() {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: ({ action, runIds }: Wish) =>
      unwrap(client.POST('/api/runs/actions', { body: { action, run_ids: [...runIds] } })),
    onSuccess: () => refreshRuns(queries),
  });
}

/** Give runs a priority. */
export function useSetPriority() {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: ({ runIds, priority }: { runIds: readonly string[]; priority: number }) =>
      unwrap(client.PUT('/api/runs/priority', { body: { run_ids: [...runIds], priority } })),
    onSuccess: () => refreshRuns(queries),
  });
}

/** Fetch again what shows runs: lists, single ones, queue, workers. */
export async function refreshRuns(queries: QueryClient): Promise<void> {
  await Promise.all(
    [['runs', 'list'], ['runs', 'one'], ['runs', 'events'], ['queue'], ['workers']].map((queryKey) =>
      queries.invalidateQueries({ queryKey }),
    ),
  );
}
