/** Paint curves of many runs on a uPlot canvas: bands, seeds, centres, and where seeds have ended. */
import uPlot from 'uplot';
import { type Curve, type Emphasis, isFaded, type Values } from '@/lib/curves';
import type { LineStyle } from '@/lib/palette';

const FADED = 0.14;
const BAND = 0.17;
const SEED = 0.38;
const RAW = 0.32;
/** Half the height of the mark where seeds have ended [px]. */
const LOSS = 4;

/** A place on the canvas: left, top [px]. */
type Spot = [number, number];

interface Pen {
  readonly plot: uPlot;
  readonly isLog: boolean;
  readonly ratio: number;
}

/** Paint all curves; what stands out is painted last, over the faded others. */
export function drawCurves(
  plot: uPlot,
  curves: readonly Curve[],
  emphasis: Emphasis | null,
  isLog: boolean,
  isSmoothed: boolean,
): void {
  const { ctx, bbox } = plot;
  const pen: Pen = { plot, isLog, ratio: uPlot.pxRatio };
  const ordered = [...curves].sort(
    (one, other) => Number(one.key === emphasis?.key) - Number(other.key === emphasis?.key),
  );
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.lineJoin = 'round';
  for (const curve of ordered) drawBand(pen, curve, emphasis);
  for (const curve of ordered) drawSeeds(pen, curve, emphasis, isSmoothed);
  for (const curve of ordered) drawCentre(pen, curve, emphasis, isSmoothed);
  ctx.restore();
}

function drawBand(pen: Pen, { key, style, x, low, high }: Curve, emphasis: Emphasis | null): void {
  const { ctx } = pen.plot;
  ctx.globalAlpha = BAND * (isFaded(key, undefined, emphasis) ? FADED * 2 : 1);
  ctx.fillStyle = style.color;
  for (const [start, end] of stretches(low, high)) {
    ctx.beginPath();
    for (let row = start; row < end; row += 1) ctx.lineTo(...spot(pen, x[row], lifted(pen, high[row])));
    for (let row = end - 1; row >= start; row -= 1) ctx.lineTo(...spot(pen, x[row], lifted(pen, low[row])));
    ctx.fill();
  }
}

function drawSeeds(
  pen: Pen,
  { key, style, centre, seeds }: Curve,
  emphasis: Emphasis | null,
  isSmoothed: boolean,
): void {
  const isAlone = centre.length === 0;
  for (const { runId, x, y, raw } of seeds) {
    const strength = isFaded(key, runId, emphasis) ? FADED / 2 : isAlone || emphasis?.runId === runId ? 0.9 : SEED;
    if (isSmoothed && isAlone) drawLine(pen, x, raw, { color: style.color, dash: [] }, 1, strength * RAW);
    drawLine(pen, x, y, isAlone ? style : { color: style.color, dash: [] }, isAlone ? 1.3 : 1, strength);
  }
}

function drawCentre(pen: Pen, curve: Curve, emphasis: Emphasis | null, isSmoothed: boolean): void {
  const { key, style, x, centre, raw, losses } = curve;
  // A run that stands out is read against its group, so that fades too.
  const strength = isFaded(key, undefined, emphasis) ? FADED : emphasis?.runId === undefined ? 1 : SEED;
  if (isSmoothed) drawLine(pen, x, raw, { color: style.color, dash: [] }, 1, strength * RAW);
  drawLine(pen, x, centre, style, 2, strength);
  for (const loss of losses) drawLoss(pen, spot(pen, loss.x, loss.y), style.color, strength);
}

function drawLine(pen: Pen, x: readonly number[], y: Values, style: LineStyle, width: number, strength: number): void {
  const { ctx } = pen.plot;
  ctx.globalAlpha = strength;
  ctx.strokeStyle = style.color;
  ctx.fillStyle = style.color;
  ctx.lineWidth = width * pen.ratio;
  ctx.setLineDash(style.dash.map((length) => length * pen.ratio));
  const pieces = piecesOf(pen, x, y);
  ctx.beginPath();
  for (const [first, ...rest] of pieces) {
    ctx.moveTo(...first);
    for (const next of rest) ctx.lineTo(...next);
  }
  ctx.stroke();
  // A line of one point has no length.
  for (const [first, ...rest] of pieces) if (rest.length === 0) drawDot(pen, first, width);
}

function drawDot({ plot: { ctx }, ratio }: Pen, [left, top]: Spot, width: number): void {
  ctx.beginPath();
  ctx.arc(left, top, (width + 1) * ratio, 0, 2 * Math.PI);
  ctx.fill();
}

/** A cross on the curve: from here on it is made of fewer seeds. */
function drawLoss({ plot, ratio }: Pen, [left, top]: Spot, color: string, strength: number): void {
  const { ctx } = plot;
  const half = LOSS * ratio;
  ctx.globalAlpha = strength;
  ctx.strokeStyle = color;
  ctx.lineWidth = 1.8 * ratio;
  ctx.setLineDash([]);
  ctx.beginPath();
  ctx.moveTo(left - half, top - half);
  ctx.lineTo(left + half, top + half);
  ctx.moveTo(left - half, top + half);
  ctx.lineTo(left + half, top - half);
  ctx.stroke();
}

/** Where a point lies on the canvas; not a number where it has no place there. */
function spot({ plot, isLog }: Pen, x: number | undefined, y: number | null | undefined): Spot {
  if (x === undefined || y === null || y === undefined || (isLog && y <= 0)) return [Number.NaN, Number.NaN];
  const left = plot.scales.x?.distr === 3 && x <= 0 ? Number.NaN : plot.valToPos(x, 'x', true);
  return [left, plot.valToPos(y, 'y', true)];
}

/** A value as far up as a logarithmic axis begins. */
function lifted({ plot, isLog }: Pen, value: number | null | undefined): number | null | undefined {
  return isLog && typeof value === 'number' && value <= 0 ? plot.scales.y?.min : value;
}

/** The points of a line, parted where a value has no place on the axis; what is missing parts nothing. */
function piecesOf(pen: Pen, x: readonly number[], y: Values): [Spot, ...Spot[]][] {
  const pieces: [Spot, ...Spot[]][] = [];
  let isParted = true;
  for (let row = 0; row < x.length; row += 1) {
    const point = spot(pen, x[row], y[row]);
    const piece = pieces.at(-1);
    if (point.some(Number.isNaN)) isParted ||= typeof y[row] === 'number';
    else if (isParted || piece === undefined) {
      pieces.push([point]);
      isParted = false;
    } else piece.push(point);
  }
  return pieces;
}

/** Rows from start to end (exclusive) in which both columns have values. */
function stretches(low: Values, high: Values): [number, number][] {
  const found: [number, number][] = [];
  let start = -1;
  for (let row = 0; row <= low.length; row += 1) {
    const isThere = typeof low[row] === 'number' && typeof high[row] === 'number';
    if (isThere && start === -1) start = row;
    if (!isThere && start !== -1) {
      found.push([start, row]);
      start = -1;
    }
  }
  return found;
}
