/** Curves of many runs: what a chart of them draws, and what it reads off them. */
import type { LineStyle } from '@/lib/palette';
import type { Range } from '@/lib/zoom';

export type Values = readonly (number | null)[];

/** The curve of one run. */
export interface SeedCurve {
  readonly runId: string;
  readonly seed: number;
  readonly x: readonly number[];
  /** As drawn, smoothed where that is asked for. */
  readonly y: Values;
  /** As logged. */
  readonly raw: Values;
}

/** A place where seeds of a curve have ended and others go on. */
export interface SeedLoss {
  readonly x: number;
  readonly y: number;
  /** Seeds from here on. */
  readonly n: number;
}

/** The curve of a group of runs that differ in nothing but the seed. */
export interface Curve {
  /** What the group goes by in every chart. */
  readonly key: string;
  readonly label: string;
  readonly style: LineStyle;
  readonly x: readonly number[];
  /** The centre as drawn, smoothed where that is asked for; empty where only the seeds are drawn. */
  readonly centre: Values;
  /** The centre as computed. */
  readonly raw: Values;
  /** The ends of the band; empty where there is none. */
  readonly low: Values;
  readonly high: Values;
  /** How many seeds each point is made of. */
  readonly n: readonly number[];
  /** The seeds' own curves, where they are drawn. */
  readonly seeds: readonly SeedCurve[];
  readonly losses: readonly SeedLoss[];
}

/** What stands out while the other curves fade: a group, or one run of it. */
export interface Emphasis {
  readonly key: string;
  readonly runId?: string;
}

/** Every x at which a curve has a point, ascending, each once. */
export function placesOf(curves: readonly Curve[]): readonly number[] {
  const places = curves.flatMap(({ x, seeds }) => [...x, ...seeds.flatMap((seed) => seed.x)]);
  return [...new Set(places)].sort((one, other) => one - other);
}

/** The row of a column that holds at a place: the last one at or before it, -1 before the start and past the end. */
export function rowAt(x: readonly number[], place: number): number {
  const last = x.at(-1);
  if (last === undefined || place > last) return -1;
  let low = 0;
  let high = x.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((x[middle] ?? 0) <= place) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** The least and the greatest value drawn within a window of x; null where nothing is. */
export function extentOf(curves: readonly Curve[], window: Range, isLog: boolean): Range | null {
  let low = Number.POSITIVE_INFINITY;
  let high = Number.NEGATIVE_INFINITY;
  const take = (x: readonly number[], ...columns: Values[]): void => {
    for (let row = 0; row < x.length; row += 1) {
      const place = x[row] ?? Number.NaN;
      if (place < window[0] || place > window[1]) continue;
      for (const column of columns) {
        const value = column[row];
        if (value === null || value === undefined || (isLog && value <= 0)) continue;
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
  };
  for (const curve of curves) {
    take(curve.x, curve.centre, curve.raw, curve.low, curve.high);
    for (const seed of curve.seeds) take(seed.x, seed.y, seed.raw);
  }
  return low <= high ? [low, high] : null;
}

/** A window that holds two others. */
export function hull(one: Range | null, other: Range | null): Range | null {
  if (one === null || other === null) return one ?? other;
  return [Math.min(one[0], other[0]), Math.max(one[1], other[1])];
}

/**
 * The curve, or the run, that passes nearest to a point of the chart.
 * @param heightOf where a value lies [px]
 * @param reach the farthest that still counts [px]
 */
export function nearestCurve(
  curves: readonly Curve[],
  place: number,
  height: number,
  heightOf: (value: number) => number,
  reach: number,
): Required<Emphasis> | { readonly key: string } | null {
  let found: Required<Emphasis> | { readonly key: string } | null = null;
  let least = reach;
  const consider = (x: readonly number[], y: Values, emphasis: NonNullable<typeof found>): void => {
    const value = y[rowAt(x, place)];
    if (value === null || value === undefined) return;
    const distance = Math.abs(heightOf(value) - height);
    if (distance >= least) return;
    least = distance;
    found = emphasis;
  };
  for (const { key, x, centre, seeds } of curves) {
    consider(x, centre, { key });
    for (const seed of seeds) consider(seed.x, seed.y, { key, runId: seed.runId });
  }
  return found;
}

/** Whether a curve keeps its full strength beside what stands out. */
export function isFaded(key: string, runId: string | undefined, emphasis: Emphasis | null): boolean {
  if (emphasis === null) return false;
  return emphasis.key !== key || (emphasis.runId !== undefined && emphasis.runId !== runId);
}
