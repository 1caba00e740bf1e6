/** Tags and notes of runs. */
import { queryOptions, useMutation, useQueryClient } from '@tanstack/react-query';
import { client, unwrap } from '@/lib/api';
import { piecesOf, refreshRuns } from '@/lib/use-run-actions';

/** Characters of a tag. */
export const LONGEST_TAG = 40;

/** Characters of a run's notes. */
export const LONGEST_NOTES = 10_000;

/** Every tag in use. */
export const tagsQuery = queryOptions({
  queryKey: ['tags'],
  queryFn: ({ signal }) => unwrap(client.GET('/api/tags', { signal })),
});

export interface TagWish {
  readonly runIds: readonly string[];
  readonly add?: readonly string[];
  readonly remove?: readonly string[];
}

/** Give runs tags and take others away. */
export function useChangeTags() {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: async ({ runIds, add = [], remove = [] }: TagWish): Promise<void> => {
      for (const run_ids of piecesOf(runIds)) {
        await unwrap<unknown>(client.POST('/api/runs/tags', { body: { run_ids, add: [...add], remove: [...remove] } }));
      }
    },
    onSettled: () => Promise.all([refreshRuns(queries), queries.invalidateQueries({ queryKey: tagsQuery.queryKey })]),
  });
}

/** Replace the notes of a run. */
export function useSetNotes(runId: string) {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: async (notes: string): Promise<void> => {
      const params = { path: { run_id: runId } };
      await unwrap<unknown>(client.PUT('/api/runs/{run_id}/notes', { params, body: { notes } }));
    },
    onSuccess: () => queries.invalidateQueries({ queryKey: ['runs', 'one', runId] }),
  });
}
