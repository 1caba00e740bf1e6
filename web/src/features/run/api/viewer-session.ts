/** One 3D session: asked for, waited for, and closed when nobody looks any more. */
import { useMutation, useQuery } from '@tanstack/react-query';
import { useEffect } from 'react';
import type { InspectorView, ViewerSession } from '@/client/schema.gen';
import { client, Refused, unwrap } from '@/lib/api';
import type { SceneRequest } from '../scene-choice';

const STARTING_POLL_MS = 250; // [ms]
const READY_POLL_MS = 5_000; // [ms]

/** Open, follow and close a 3D session. */
export function useViewerSession() {
  const opening = useMutation({
    mutationFn: (request: SceneRequest | InspectorView) =>
      unwrap(client.POST('/api/viewer-sessions', { body: request })),
  });
  const id = opening.data?.id;
  const following = useQuery({
    queryKey: ['viewer', id],
    queryFn: ({ signal }) =>
      unwrap(client.GET('/api/viewer-sessions/{session_id}', { params: { path: { session_id: id ?? '' } }, signal })),
    enabled: id !== undefined,
    refetchInterval: ({ state }) => (state.data?.state === 'starting' ? STARTING_POLL_MS : READY_POLL_MS),
    gcTime: 0,
  });
  useEffect(() => {
    if (id === undefined) return;
    const close = (): void => closeSession(id);
    window.addEventListener('pagehide', close);
    return () => {
      window.removeEventListener('pagehide', close);
      close();
    };
  }, [id]);
  const session: ViewerSession | undefined = id === undefined ? undefined : (following.data ?? opening.data);
  // A question that fails once says nothing about a view that is open; that there is no such session does.
  const isGone = following.error instanceof Refused && following.error.status === 404;
  return {
    session,
    isOpening: opening.isPending,
    error: opening.error ?? (following.data === undefined || isGone ? following.error : null),
    open: opening.mutate,
    close: opening.reset,
  };
}

// keepalive lets the request outlive the page; a session that it misses ends by itself when idle.
function closeSession(id: string): void {
  const params = { path: { session_id: id } };
  client.DELETE('/api/viewer-sessions/{session_id}', { params, keepalive: true }).catch(() => undefined);
}
