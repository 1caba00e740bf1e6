/** Requests about runs that several features share. */
import { queryOptions } from '@tanstack/react-query';
import { client, unwrap } from '@/lib/api';

/** How often live data is asked for [ms]. */
export const POLL_MS = 2_000;

/** How often data that rarely changes is asked for [ms]. */
export const SLOW_POLL_MS = 5_000;

/** All that a launch can choose from; it changes only with the server's version. */
export const choicesQuery = queryOptions({
  queryKey: ['choices'],
  queryFn: ({ signal }) => unwrap(client.GET('/api/choices', { signal })),
  staleTime: Number.POSITIVE_INFINITY,
});

/** Whether there is any run at all: the newest one, and how many there are. */
export const anyRunQuery = queryOptions({
  queryKey: ['runs', 'any'],
  queryFn: ({ signal }) => unwrap(client.GET('/api/runs', { params: { query: { limit: 1 } }, signal })),
});

/** One run, kept fresh. */
export function runQuery(runId: string) {
  return queryOptions({
    queryKey: ['runs', 'one', runId],
    queryFn: ({ signal }) => unwrap(client.GET('/api/runs/{run_id}', { params: { path: { run_id: runId } }, signal })),
    refetchInterval: POLL_MS,
  });
}

/** Whether the service can do its work. */
export const healthQuery = queryOptions({
  queryKey: ['health'],
  queryFn: ({ signal }) => unwrap(client.GET('/healthz', { signal })),
  refetchInterval: SLOW_POLL_MS,
});

/** The workers known to the store. */
export const workersQuery = queryOptions({
  queryKey: ['workers'],
  queryFn: ({ signal }) => unwrap(client.GET('/api/workers', { signal })),
  refetchInterval: POLL_MS,
});

/** A config as the server would fill it for this choice. */
export function defaultsQuery(choice: {
  task: string;
  phase: 'locomotion' | 'manipulation';
  method: string;
  preset: string;
}) {
  return queryOptions({
    queryKey: ['defaults', choice],
    queryFn: ({ signal }) => unwrap(client.GET('/api/defaults', { params: { query: choice }, signal })),
    staleTime: Number.POSITIVE_INFINITY,
  });
}
