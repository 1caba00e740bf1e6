/** What is drawn beside the curves: where attempts began, and what later attempts replaced. */
import uPlot from 'uplot';

/** A place on the x axis with a few words. */
export interface Mark {
  readonly x: number;
  readonly label: string;
}

/** A stretch of one line that no longer counts. */
export interface Ghost {
  /** Which line it was part of. */
  readonly line: number;
  readonly x: readonly number[];
  readonly y: readonly (number | null)[];
}

/** The range that holds the ghosts within a window too; null where there is nothing. */
export function withGhosts(
  low: number | null,
  high: number | null,
  ghosts: readonly Ghost[],
  window: readonly [number, number],
): [number | null, number | null] {
  const seen = ghosts.flatMap(({ x, y }) =>
    y.filter((value, at): value is number => value !== null && inside(x[at] ?? Number.NaN, window)),
  );
  if (low !== null) seen.push(low);
  if (high !== null) seen.push(high);
  return seen.length === 0 ? [null, null] : [Math.min(...seen), Math.max(...seen)];
}

/** Draw replaced stretches, faint and finely dotted. */
export function drawGhosts(plot: uPlot, ghosts: readonly Ghost[], colorOf: (line: number) => string): void {
  const { ctx, bbox } = plot;
  const ratio = uPlot.pxRatio;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.lineWidth = 1.4 * ratio;
  ctx.setLineDash([1.5 * ratio, 2.5 * ratio]);
  ctx.globalAlpha = 0.6;
  for (const { line, x, y } of ghosts) {
    ctx.strokeStyle = colorOf(line);
    ctx.beginPath();
    y.forEach((value, at) => {
      if (value !== null) ctx.lineTo(plot.valToPos(x[at] ?? 0, 'x', true), plot.valToPos(value, 'y', true));
    });
    ctx.stroke();
  }
  ctx.restore();
}

/** Draw a dashed line with its words at each mark. */
export function drawMarks(plot: uPlot, marks: readonly Mark[], color: string): void {
  const { ctx, bbox } = plot;
  const ratio = uPlot.pxRatio;
  ctx.save();
  ctx.strokeStyle = color;
  ctx.fillStyle = color;
  ctx.lineWidth = ratio;
  ctx.font = `${10 * ratio}px system-ui, sans-serif`;
  ctx.textAlign = 'left';
  ctx.textBaseline = 'alphabetic';
  ctx.setLineDash([3 * ratio, 3 * ratio]);
  const gap = 4 * ratio;
  // How far to the right each row of labels is written on; labels that would touch stand below each other.
  const written: number[] = [];
  for (const { x, label } of [...marks].sort((one, other) => one.x - other.x)) {
    const left = plot.valToPos(x, 'x', true);
    if (!inside(left, [bbox.left, bbox.left + bbox.width])) continue;
    ctx.beginPath();
    ctx.moveTo(left, bbox.top);
    ctx.lineTo(left, bbox.top + bbox.height);
    ctx.stroke();
    const width = ctx.measureText(label).width;
    const fits = left + gap + width < bbox.left + bbox.width;
    const start = fits ? left + gap : left - gap - width;
    const free = written.findIndex((end) => end + gap < start);
    const row = free === -1 ? written.length : free;
    written[row] = start + width;
    ctx.fillText(label, start, bbox.top + (10 + 12 * row) * ratio);
  }
  ctx.restore();
}

function inside(value: number, [start, end]: readonly [number, number]): boolean {
  return value >= start && value <= end;
}
