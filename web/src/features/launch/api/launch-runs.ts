/** Queue the runs of a launch. */
import { useMutation, useQueryClient } from '@tanstack/react-query';
import type { Launch } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';

export function useLaunch() {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: (launch: Launch) => unwrap(client.POST('/api/launches', { body: launch })),
    onSuccess: () =>
      Promise.all([
        queries.invalidateQueries({ queryKey: ['runs'] }),
        queries.invalidateQueries({ queryKey: ['plan'] }),
      ]),
  });
}
