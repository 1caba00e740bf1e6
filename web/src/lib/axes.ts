/** What curves are drawn over, and how places on it are written. */
import { formatCount, formatDuration, formatShort } from '@/lib/format';

export type Axis = 'epoch' | 'env_steps' | 'episodes' | 'updates' | 'wall_seconds';

export const AXIS_NAMES: Readonly<Record<Axis, string>> = {
  epoch: 'Epoch',
  env_steps: 'Env steps',
  episodes: 'Episodes',
  updates: 'Updates',
  wall_seconds: 'Wall time',
};

/** Ticks of the wall time lie on round numbers of seconds, minutes, hours or days [s]. */
const TIME_STEPS = [
  1, 5, 10, 30, 60, 120, 300, 600, 1800, 3600, 7200, 18_000, 36_000, 86_400, 172_800, 432_000, 864_000, 1_728_000,
];

/** Ticks of epochs lie on whole ones, or on tenths between them: nothing happens at epoch 2.5. */
const EPOCH_STEPS = [0.1, 0.2, 0.5, ...[1, 10, 100, 1000].flatMap((power) => [power, 2 * power, 5 * power])];

/** Distances that ticks of an axis may have, where plain round numbers read badly. */
export function xSteps(axis: Axis): readonly number[] | undefined {
  if (axis === 'wall_seconds') return TIME_STEPS;
  return axis === 'epoch' ? EPOCH_STEPS : undefined;
}

/**
 * A place on the x axis as text.
 * @param step the distance of the ticks, which then read differently
 */
export function formatX(axis: Axis, value: number, step?: number): string {
  if (axis === 'wall_seconds') return formatDuration(value, step);
  return axis === 'epoch' ? String(Number(value.toFixed(2))) : formatShort(value, step);
}

/** A place on the x axis to its last digit. */
export function formatPlace(axis: Axis, value: number): string {
  return axis === 'wall_seconds' || axis === 'epoch' ? formatX(axis, value) : formatCount(value);
}

/** Whether the values of a metric are shares from 0 to 1. */
export function isShare(metric: string): boolean {
  return /(success_rate|fraction|share)$/.test(metric);
}
