/** A run's history, its attempts and its stored files. */
import { queryOptions } from '@tanstack/react-query';
import { client, unwrap } from '@/lib/api';
import { SLOW_POLL_MS } from '@/lib/queries';

export function eventsQuery(runId: string) {
  return queryOptions({
    queryKey: ['runs', 'events', runId],
    queryFn: ({ signal }) =>
      unwrap(client.GET('/api/runs/{run_id}/events', { params: { path: { run_id: runId } }, signal })),
    refetchInterval: SLOW_POLL_MS,
  });
}

export function attemptsQuery(runId: string) {
  return queryOptions({
    queryKey: ['runs', 'attempts', runId],
    queryFn: ({ signal }) =>
      unwrap(client.GET('/api/runs/{run_id}/attempts', { params: { path: { run_id: runId } }, signal })),
    refetchInterval: SLOW_POLL_MS,
  });
}

export function filesQuery(runId: string) {
  return queryOptions({
    queryKey: ['runs', 'files', runId],
    queryFn: ({ signal }) =>
      unwrap(client.GET('/api/runs/{run_id}/files', { params: { path: { run_id: runId } }, signal })),
    refetchInterval: SLOW_POLL_MS,
  });
}
