/** Put a waiting run before another one, or at the end; the page shows it at once. */
import { useMutation, useQueryClient } from '@tanstack/react-query';
import type { Queue } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';
import { refreshRuns } from '@/lib/use-run-actions';
import { type Move, reordered } from '../order';
import { QUEUE_KEY } from './get-queue';

export function useMoveRun() {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: ({ runId, before }: Move) =>
      unwrap(client.POST('/api/runs/{run_id}/move', { params: { path: { run_id: runId } }, body: { before } })),
    onMutate: async (move) => {
      await queries.cancelQueries({ queryKey: QUEUE_KEY });
      const known = queries.getQueriesData<Queue>({ queryKey: QUEUE_KEY });
      queries.setQueriesData<Queue>(
        { queryKey: QUEUE_KEY },
        (queue) => queue && { ...queue, entries: reordered(queue.entries, move) },
      );
      return known;
    },
    onError: (_error, _move, known = []) => {
      for (const [key, queue] of known) queries.setQueryData(key, queue);
    },
    onSettled: () => refreshRuns(queries),
  });
}
