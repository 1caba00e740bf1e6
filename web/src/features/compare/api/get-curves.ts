/** The curves of the chosen runs, kept fresh. */
import { keepPreviousData, queryOptions } from '@tanstack/react-query';
import type { CurveComparison } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';
import { SLOW_POLL_MS } from '@/lib/queries';
import { type CompareSearch, USUAL_LEVEL, USUAL_METRIC } from '../search';
import { choiceOf } from './choice';

/** How the curves are looked at, as the server is asked for it. */
export function viewOf({ metric, x, statistic, level, seeds, drop }: CompareSearch) {
  return {
    metric: metric ?? USUAL_METRIC,
    x: x ?? 'epoch',
    statistic: statistic ?? 'median',
    level: level ?? USUAL_LEVEL,
    seeds: seeds === 'yes',
    drop_ended: drop === 'yes',
  } as const;
}

export function curvesQuery(search: CompareSearch) {
  const query = { ...choiceOf(search), ...viewOf(search) };
  return queryOptions({
    queryKey: ['compare', 'curves', query],
    queryFn: ({ signal }) => unwrap(client.GET('/api/compare', { params: { query }, signal })),
    refetchInterval: SLOW_POLL_MS,
    placeholderData: keepPreviousData,
    // An answer made of the same data is the same: nothing is drawn again for it.
    structuralSharing: (known, fresh) => {
      const [old, next] = [known as CurveComparison | undefined, fresh as CurveComparison];
      return old?.version === next.version ? old : next;
    },
  });
}

/** The metrics that the chosen runs have logged. */
export function comparedMetricsQuery(search: CompareSearch) {
  const query = choiceOf(search);
  return queryOptions({
    queryKey: ['compare', 'metrics', query],
    queryFn: ({ signal }) => unwrap(client.GET('/api/compare/metrics', { params: { query }, signal })),
    placeholderData: keepPreviousData,
  });
}
