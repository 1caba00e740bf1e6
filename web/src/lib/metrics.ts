/** The curves of one run as columns that grow batch by batch. */
import type { MetricBatch } from '@/client/schema.gen';

/** Every point of a run known so far; all columns are equally long. */
export type Metrics = MetricBatch;

const KEYS = ['attempt', 'step', 'epoch', 'env_steps', 'episodes', 'updates', 'wall_seconds'] as const;

/** No points yet. */
export const NO_METRICS: Metrics = {
  cursor: 0,
  attempt: [],
  step: [],
  epoch: [],
  env_steps: [],
  episodes: [],
  updates: [],
  wall_seconds: [],
  values: {},
};

/**
 * Put a batch behind what is known.
 * Where a later attempt resumed from a checkpoint, its points replace those from its first step on.
 */
export function mergeMetrics(known: Metrics, batch: MetricBatch): Metrics {
  const first = batch.step[0];
  if (first === undefined) return known.cursor === batch.cursor ? known : { ...known, cursor: batch.cursor };
  const kept = countBefore(known.step, first);
  const added = batch.step.length;
  const column = (key: (typeof KEYS)[number]): number[] => [...known[key].slice(0, kept), ...batch[key]];
  const values: Record<string, (number | null)[]> = {};
  for (const name of new Set([...Object.keys(known.values), ...Object.keys(batch.values)])) {
    values[name] = [
      ...(known.values[name]?.slice(0, kept) ?? Array<null>(kept).fill(null)),
      ...(batch.values[name] ?? Array<null>(added).fill(null)),
    ];
  }
  return {
    cursor: batch.cursor,
    attempt: column('attempt'),
    step: column('step'),
    epoch: column('epoch'),
    env_steps: column('env_steps'),
    episodes: column('episodes'),
    updates: column('updates'),
    wall_seconds: column('wall_seconds'),
    values,
  };
}

/** Indices at which a later attempt took over. */
export function attemptStarts(metrics: Metrics): number[] {
  return metrics.attempt.flatMap((attempt, at) => (at > 0 && attempt !== metrics.attempt[at - 1] ? [at] : []));
}

/** The newest value of a metric, or null if it was never logged. */
export function newestValue(column: readonly (number | null)[]): number | null {
  return column.findLast((value) => value !== null) ?? null;
}

function countBefore(steps: readonly number[], first: number): number {
  const at = steps.findIndex((step) => step >= first);
  return at === -1 ? steps.length : at;
}
