/** The videos of a run: which there are, and asking for one. */
import { queryOptions, useMutation, useQueryClient } from '@tanstack/react-query';
import type { Video, VideoOrder } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';

const DRAWING_POLL_MS = 1_000; // [ms]
const RESTING_POLL_MS = 20_000; // [ms]

export function isOnItsWay(video: Video): boolean {
  return video.state === 'queued' || video.state === 'running';
}

export function videosQuery(runId: string) {
  return queryOptions({
    queryKey: ['runs', 'videos', runId],
    queryFn: ({ signal }) =>
      unwrap(client.GET('/api/runs/{run_id}/videos', { params: { path: { run_id: runId } }, signal })),
    refetchInterval: ({ state }) => (state.data?.videos.some(isOnItsWay) ? DRAWING_POLL_MS : RESTING_POLL_MS),
  });
}

export function useOrderVideo(runId: string) {
  const queries = useQueryClient();
  return useMutation({
    mutationFn: (order: VideoOrder) =>
      unwrap(client.POST('/api/runs/{run_id}/videos', { params: { path: { run_id: runId } }, body: order })),
    onSuccess: () => queries.invalidateQueries({ queryKey: videosQuery(runId).queryKey }),
  });
}
