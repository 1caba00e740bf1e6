/** Put a waiting run before another one, or at the end; the page shows it at once. */
import { useMutation, useQueryClient } from '@tanstack/react-query';
import { client, unwrap } from '@/lib/api';
import { refreshRuns } from '@/lib/use-run-actions';
import { type Move, reordered } from '../order';
import { queueQuery } from './get-queue';

export function useMoveRun() {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: ({ runId, before }: Move) =>
      unwrap(client.POST('/api/runs/{run_id}/move', { params: { path: { run_id: runId } }, body: { before } })),
    onMutate: async (move) => {
      await queries.cancelQueries(queueQuery);
      queries.setQueryData(queueQuery.queryKey, (queue) => queue && { entries: reordered(queue.entries, move) });
    },
    onSettled: () => refreshRuns(queries),
  });
}
