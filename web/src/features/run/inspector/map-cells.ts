/** The cells of a map, out of what the session counts. */
import type { HeatCells } from '@/lib/heat-map';
import type { CoverageAnswer } from './answers';

export type Measure = 'success' | 'time';

/** Stands for the sum over all layers. */
export const ALL_LAYERS = -1;

/** One layer of a map, or all of them together. */
export interface Layer {
  readonly episodes: readonly (readonly number[])[];
  readonly successes: readonly (readonly number[])[];
  /** Median time to goal [s]; of several layers their mean, weighted by their successes. */
  readonly median_s: HeatCells;
}

/** Return a layer by its number. */
export function onLayer(covered: CoverageAnswer, layer: number): Layer {
  if (layer !== ALL_LAYERS) {
    return {
      episodes: covered.episodes[layer] ?? [],
      successes: covered.successes[layer] ?? [],
      median_s: covered.median_s[layer] ?? [],
    };
  }
  const sum = (counts: CoverageAnswer['episodes'], row: number, column: number): number =>
    counts.reduce((total, rows) => total + (rows[row]?.[column] ?? 0), 0);
  const rows = (covered.episodes[0] ?? []).map((row) => row.map((_, column) => column));
  return {
    episodes: rows.map((row, up) => row.map((column) => sum(covered.episodes, up, column))),
    successes: rows.map((row, up) => row.map((column) => sum(covered.successes, up, column))),
    median_s: rows.map((row, up) => row.map((column) => weightedTime(covered, up, column))),
  };
}

/** Return what is drawn; cells without a demonstration, or without a success to time, are empty. */
export function mapCells(layer: Layer, measure: Measure): HeatCells {
  if (measure === 'time') return layer.median_s;
  return layer.episodes.map((row, up) =>
    row.map((done, across) => (done === 0 ? null : (layer.successes[up]?.[across] ?? 0) / done)),
  );
}

function weightedTime({ successes, median_s }: CoverageAnswer, row: number, column: number): number | null {
  let [time, weight] = [0, 0];
  median_s.forEach((rows, layer) => {
    const count = successes[layer]?.[row]?.[column] ?? 0;
    const median = rows[row]?.[column] ?? null;
    if (median === null) return;
    time += count * median;
    weight += count;
  });
  return weight === 0 ? null : time / weight;
}
