/** Windows on an axis: made smaller, larger, or moved, and never beyond the whole. */

export type Range = readonly [number, number];

/** The smallest share of the whole that a window may show. */
const LEAST_SHARE = 1 / 1000;

/** A window scaled about a place that keeps its position in it; null where it shows the whole. */
export function scaled(range: Range, whole: Range, place: number, factor: number): Range | null {
  const width = Math.max((range[1] - range[0]) * factor, (whole[1] - whole[0]) * LEAST_SHARE);
  const kept = range[1] > range[0] ? Math.min(1, Math.max(0, (place - range[0]) / (range[1] - range[0]))) : 0.5;
  return within([place - kept * width, place + (1 - kept) * width], whole);
}

/** A window moved by a share of its width, up to the ends of the whole. */
export function moved(range: Range, whole: Range, share: number): Range | null {
  const shift = (range[1] - range[0]) * share;
  return within([range[0] + shift, range[1] + shift], whole);
}

/** A window moved just so far that it shows a place. */
export function showing(range: Range, whole: Range, place: number): Range | null {
  const shift = Math.min(0, place - range[0]) + Math.max(0, place - range[1]);
  return within([range[0] + shift, range[1] + shift], whole);
}

function within(range: Range, whole: Range): Range | null {
  const width = range[1] - range[0];
  if (width >= whole[1] - whole[0]) return null;
  const start = Math.min(Math.max(range[0], whole[0]), whole[1] - width);
  return [start, start + width];
}
