/** End a run for good. */
import { useMutation, useQueryClient } from '@tanstack/react-query';
import { client, unwrap } from '@/lib/api';
import { runQuery } from '@/lib/queries';

export function useCancelRun(runId: string) {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: () => unwrap(client.POST('/api/runs/{run_id}/cancel', { params: { path: { run_id: runId } } })),
    onSuccess: (run) => {
      queries.setQueryData(runQuery(runId).queryKey, run);
      return queries.invalidateQueries({ queryKey: ['runs', 'list'] });
    },
  });
}
