/** The curves of one run as columns that grow batch by batch. */
import type { MetricBatch } from '@/client/schema.gen';

/** Every point of a run known so far; all columns are equally long. */
export interface Metrics extends MetricBatch {
  /** Stretches of the curve that a later attempt replaced, oldest first; each starts where the curve left it. */
  readonly replaced: readonly MetricBatch[];
}

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
  replaced: [],
};

/**
 * Put a batch behind what is known.
 * Where a later attempt resumed from a checkpoint, its points replace those from its first step on.
 */
export function mergeMetrics(known: Metrics, batch: MetricBatch): Metrics {
  if (batch.step.length === 0) return known.cursor === batch.cursor ? known : { ...known, cursor: batch.cursor };
  return stretches(batch).reduce(append, known);
}

/** Where an attempt after the first began. */
export interface AttemptStart {
  readonly attempt: number;
  /** The stretch that holds the attempt's first point, and its row in it. */
  readonly part: MetricBatch;
  readonly row: number;
}

/** Where the later attempts took over, also those that were replaced in turn. */
export function attemptStarts(metrics: Metrics): AttemptStart[] {
  const starts = new Map<number, AttemptStart>();
  for (const part of [...metrics.replaced, metrics]) {
    part.attempt.forEach((attempt, row) => {
      const known = starts.get(attempt);
      if (known === undefined || stepOf(part, row) < stepOf(known.part, known.row)) {
        starts.set(attempt, { attempt, part, row });
      }
    });
  }
  const first = Math.min(...starts.keys());
  return [...starts.values()]
    .filter(({ attempt }) => attempt > first)
    .sort((one, other) => one.attempt - other.attempt);
}

/** The newest value of a metric, or null if it was never logged. */
export function newestValue(column: readonly (number | null)[]): number | null {
  return column.findLast((value) => value !== null) ?? null;
}

function stepOf(part: MetricBatch, row: number): number {
  return part.step[row] ?? Number.POSITIVE_INFINITY;
}

/** Cut a batch where another attempt begins. */
function stretches(batch: MetricBatch): MetricBatch[] {
  const cuts = batch.attempt.flatMap((attempt, row) => (row === 0 || attempt !== batch.attempt[row - 1] ? [row] : []));
  return cuts.map((start, at) => slice(batch, start, cuts[at + 1]));
}

function append(known: Metrics, added: MetricBatch): Metrics {
  const kept = countBefore(known.step, added.step[0] ?? 0);
  const isLater = (added.attempt[0] ?? 0) > (known.attempt.at(-1) ?? 0);
  // The point before the cut belongs to both, so that the replaced stretch begins on the curve.
  const replaced = isLater && kept < known.step.length ? [slice(known, Math.max(0, kept - 1))] : [];
  return { ...join(slice(known, 0, kept), added), replaced: [...known.replaced, ...replaced] };
}

function slice(batch: MetricBatch, start: number, end?: number): MetricBatch {
  const columns = Object.fromEntries(KEYS.map((key) => [key, batch[key].slice(start, end)])) as Pick<
    MetricBatch,
    (typeof KEYS)[number]
  >;
  const values = Object.entries(batch.values).map(([name, column]) => [name, column.slice(start, end)] as const);
  return { cursor: batch.cursor, ...columns, values: Object.fromEntries(values) };
}

function join(one: MetricBatch, other: MetricBatch): MetricBatch {
  const columns = Object.fromEntries(KEYS.map((key) => [key, [...one[key], ...other[key]]])) as Pick<
    MetricBatch,
    (typeof KEYS)[number]
  >;
  const gap = (batch: MetricBatch): null[] => Array<null>(batch.step.length).fill(null);
  const names = new Set([...Object.keys(one.values), ...Object.keys(other.values)]);
  const values = [...names].map((name): [string, (number | null)[]] => [
    name,
    [...(one.values[name] ?? gap(one)), ...(other.values[name] ?? gap(other))],
  ]);
  return { cursor: other.cursor, ...columns, values: Object.fromEntries(values) };
}

function countBefore(steps: readonly number[], first: number): number {
  const at = steps.findIndex((step) => step >= first);
  return at === -1 ? steps.length : at;
}
