/** Studies: what is asked of the server about them, and what several pages say of them. */
import { queryOptions } from '@tanstack/react-query';
import type { RunState, StudyDetail, StudySpec } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';
import { formatPlural } from '@/lib/format';
import { POLL_MS } from '@/lib/queries';
import { RUN_STATES } from '@/lib/states';

/** The template that is over in about two minutes. */
export const SAMPLE_TEMPLATE = 'two-minutes';

/** The studies that come with the product; they change only with the server's version. */
export const templatesQuery = queryOptions({
  queryKey: ['study-templates'],
  queryFn: ({ signal }) => unwrap(client.GET('/api/studies/templates', { signal })),
  staleTime: Number.POSITIVE_INFINITY,
});

/** All studies, or those that a person hid; kept fresh. */
export function studiesQuery(deleted: boolean) {
  return queryOptions({
    queryKey: ['studies', 'list', deleted],
    queryFn: ({ signal }) => unwrap(client.GET('/api/studies', { params: { query: { deleted } }, signal })),
    refetchInterval: POLL_MS,
  });
}

/** One study with all its cells, kept fresh. */
export function studyQuery(studyId: string) {
  return queryOptions({
    queryKey: ['studies', 'one', studyId],
    queryFn: ({ signal }) =>
      unwrap(client.GET('/api/studies/{study_id}', { params: { path: { study_id: studyId } }, signal })),
    refetchInterval: POLL_MS,
  });
}

export type StudyCell = StudyDetail['cells'][number];
export type StudyRun = StudyCell['runs'][number];

/** `13 tasks × 7 methods × 5 seeds`, with the variants where there are some. */
export function describeAxes({ tasks, methods, seeds, variants = [] }: StudySpec): string {
  const axes = [formatPlural(tasks.length, 'task'), formatPlural(methods.length, 'method')];
  if (variants.length > 0) axes.push(formatPlural(variants.length, 'variant'));
  return [...axes, formatPlural(seeds.length, 'seed')].join(' × ');
}

/** The columns of a study's matrix: every method, in every variant. */
export function columnsOf({ methods, variants = [] }: StudySpec): { method: string; variant: string }[] {
  const names = variants.length > 0 ? variants.map((variant) => variant.name) : [''];
  return methods.flatMap((method) => names.map((variant) => ({ method, variant })));
}

/** How many are in each state, in the order a run goes through them; states with none are left out. */
export function countedStates(states: Partial<Record<RunState, number>>): [RunState, number][] {
  return RUN_STATES.flatMap((state) => (states[state] ? [[state, states[state]] as [RunState, number]] : []));
}

/** The state that says most about several runs: what moves or will, then what needs a look. */
export function leadingState(states: Partial<Record<RunState, number>>): RunState {
  const order: readonly RunState[] = ['running', 'queued', 'blocked', 'paused', 'failed', 'cancelled'];
  return order.find((state) => states[state]) ?? 'succeeded';
}
