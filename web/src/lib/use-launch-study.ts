/** Make a study and queue its runs. */
import { useMutation, useQueryClient } from '@tanstack/react-query';
import type { StudyLaunch } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';

export function useLaunchStudy() {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: (launch: StudyLaunch) => unwrap(client.POST('/api/studies', { body: launch })),
    onSuccess: () =>
      Promise.all(
        [['studies'], ['study-preview'], ['runs'], ['queue']].map((queryKey) =>
          queries.invalidateQueries({ queryKey }),
        ),
      ),
  });
}
