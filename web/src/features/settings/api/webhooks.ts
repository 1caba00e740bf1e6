/** The addresses that are told of ended studies and failed runs. */
import { queryOptions, useMutation, useQueryClient } from '@tanstack/react-query';
import type { NewWebhook } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';
import { SLOW_POLL_MS } from '@/lib/queries';

/** Every address, with its newest messages. */
export const webhooksQuery = queryOptions({
  queryKey: ['webhooks'],
  queryFn: ({ signal }) => unwrap(client.GET('/api/webhooks', { signal })),
  refetchInterval: SLOW_POLL_MS,
});

function useChange<Wish, Answer>(mutationFn: (wish: Wish) => Promise<Answer>) {
  const queries = useQueryClient();
  return useMutation({ mutationFn, onSuccess: () => queries.invalidateQueries({ queryKey: ['webhooks'] }) });
}

/** Tell an address from now on; the answer holds the secret of its signatures. */
export function useAddWebhook() {
  return useChange((wish: NewWebhook) => unwrap(client.POST('/api/webhooks', { body: wish })));
}

/** Tell an address no more. */
export function useRemoveWebhook() {
  return useChange((id: string) =>
    unwrap(client.DELETE('/api/webhooks/{webhook_id}', { params: { path: { webhook_id: id } } })),
  );
}

/** Put a test message on its way. */
export function useTestWebhook() {
  return useChange((id: string) =>
    unwrap(client.POST('/api/webhooks/{webhook_id}/test', { params: { path: { webhook_id: id } } })),
  );
}
