/** Saved views: kept by the server, for everyone. */
import { queryOptions, useMutation, useQueryClient } from '@tanstack/react-query';
import { client, unwrap } from '@/lib/api';

export const viewsQuery = queryOptions({
  queryKey: ['views'],
  queryFn: ({ signal }) => unwrap(client.GET('/api/views', { signal })),
});

/** What can become of a view. */
export type ViewWish =
  | { kind: 'save'; name: string; search: string }
  | { kind: 'rename'; id: string; name: string }
  | { kind: 'replace'; id: string; search: string }
  | { kind: 'delete'; id: string };

export function useChangeViews() {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: async (wish: ViewWish): Promise<void> => {
      await unwrap<unknown>(send(wish));
    },
    onSuccess: () => queries.invalidateQueries({ queryKey: viewsQuery.queryKey }),
  });
}

function send(wish: ViewWish): Promise<{ data?: unknown; error?: unknown; response: Response }> {
  if (wish.kind === 'save') return client.POST('/api/views', { body: { name: wish.name, search: wish.search } });
  const params = { path: { view_id: wish.id } };
  if (wish.kind === 'rename') return client.PATCH('/api/views/{view_id}', { params, body: { name: wish.name } });
  if (wish.kind === 'replace') return client.PATCH('/api/views/{view_id}', { params, body: { search: wish.search } });
  return client.DELETE('/api/views/{view_id}', { params });
}
