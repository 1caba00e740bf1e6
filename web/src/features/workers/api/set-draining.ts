/** Let a worker take no further run, or let it take runs again. */
import { useMutation, useQueryClient } from '@tanstack/react-query';
import { client, unwrap } from '@/lib/api';
import { refreshRuns } from '@/lib/use-run-actions';

export function useSetDraining(workerId: string) {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: (draining: boolean) =>
      unwrap(
        client.PUT('/api/workers/{worker_id}/draining', {
          params: { path: { worker_id: workerId } },
          body: { draining },
        }),
      ),
    onSuccess: () => refreshRuns(queries),
  });
}
