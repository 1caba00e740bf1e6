/** Where the attempts of a run began on its charts, and what they replaced. */
import type { MetricBatch } from '@/client/schema.gen';
import type { Ghost, Mark } from '@/components/line-chart-marks';
import { attemptStarts, type Metrics } from '@/lib/metrics';
import type { ChartSpec } from './charts';

/** A mark for each place where attempts began; those that began at the same place share one. */
export function attemptMarks(metrics: Metrics, placeOf: (part: MetricBatch) => readonly number[]): Mark[] {
  const places = new Map<number, number[]>();
  for (const { attempt, part, row } of attemptStarts(metrics)) {
    const x = placeOf(part)[row] ?? 0;
    places.set(x, [...(places.get(x) ?? []), attempt]);
  }
  return [...places].map(([x, attempts]) => ({ x, label: label(attempts) }));
}

/** The replaced stretches of one chart's lines. */
export function chartGhosts(
  metrics: Metrics,
  chart: ChartSpec,
  placeOf: (part: MetricBatch) => readonly number[],
): Ghost[] {
  return metrics.replaced.flatMap((part) => {
    const x = placeOf(part);
    return chart.series.flatMap(({ metric }, line) => {
      const y = part.values[metric] ?? [];
      return y.some((value) => value !== null) ? [{ line, x, y }] : [];
    });
  });
}

function label(attempts: readonly number[]): string {
  const [first, second] = attempts;
  if (second === undefined) return `attempt ${first}`;
  return attempts.length === 2 ? `attempts ${first}, ${second}` : `attempts ${first}–${attempts.at(-1)}`;
}
