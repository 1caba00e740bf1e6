/** Ask the server for something about runs; what shows them is fetched again. */
import { type QueryClient, useMutation, useQueryClient } from '@tanstack/react-query';
import type { ActionResult } from '@/client/schema.gen';
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
    mutationFn: async ({ action, runIds }: Wish): Promise<{ results: ActionResult[] }> => {
      const results: ActionResult[] = [];
      for (const run_ids of piecesOf(runIds)) {
        results.push(...(await unwrap(client.POST('/api/runs/actions', { body: { action, run_ids } }))).results);
      }
      return { results };
    },
    onSettled: () => refreshRuns(queries),
  });
}

/** Give runs a priority. */
export function useSetPriority() {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: async ({ runIds, priority }: { runIds: readonly string[]; priority: number }): Promise<void> => {
      for (const run_ids of piecesOf(runIds)) {
        await unwrap<unknown>(client.PUT('/api/runs/priority', { body: { run_ids, priority } }));
      }
    },
    onSettled: () => refreshRuns(queries),
  });
}

/** As many runs as one request may name. */
const MOST_RUNS = 1000;

/** Runs, as many at a time as one request may name. */
export function piecesOf(runIds: readonly string[]): string[][] {
  const starts = Array.from({ length: Math.ceil(runIds.length / MOST_RUNS) }, (_, piece) => piece * MOST_RUNS);
  return starts.map((start) => runIds.slice(start, start + MOST_RUNS));
}

/** Fetch again what shows runs: lists, single ones, queue, workers. */
export async function refreshRuns(queries: QueryClient): Promise<void> {
  await Promise.all(
    [['runs', 'list'], ['runs', 'one'], ['runs', 'events'], ['queue'], ['workers']].map((queryKey) =>
      queries.invalidateQueries({ queryKey }),
    ),
  );
}
