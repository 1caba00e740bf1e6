/** Where the lines and the numbers of a logarithmic axis stand. */
import type uPlot from 'uplot';

/** Below this width of a power of ten only the powers themselves carry numbers [px]. */
const WIDE_DECADE = 110;

/** Numbers stand at least so far apart: as twice and five times a power do in the narrowest wide decade [px]. */
const NUMBER_SPACE = WIDE_DECADE * Math.log10(2);

/** A stretch without round numbers of its own is divided into at least so many parts. */
const LEAST_PARTS = 3;

/** What uPlot is to do otherwise on a logarithmic axis: its own lines begin at the end of the axis, not at round numbers. */
export function logAxis(scale: 'x' | 'y'): Pick<uPlot.Axis, 'splits' | 'filter'> {
  return {
    splits: (_plot, _axis, low, high) => axisLines(low, high),
    filter: (plot, splits) => numbered(splits, Math.abs(plot.valToPos(10, scale) - plot.valToPos(1, scale))),
  };
}

/** Where the lines stand: one to nine times every power of ten, or evenly where fewer than two of those are on the axis. */
export function axisLines(low: number, high: number): number[] {
  const round = roundNumbers(low, high);
  return round.length < 2 && low < high ? evenNumbers(low, high) : round;
}

/** One to nine times every power of ten, as far as they lie on the axis. */
function roundNumbers(low: number, high: number): number[] {
  const found: number[] = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); power += 1) {
    for (let lead = 1; lead < 10; lead += 1) {
      const value = Number(`${lead}e${power}`);
      if (value >= low && value <= high) found.push(value);
    }
  }
  return found;
}

/** Multiples of one, two or five times a power of ten. */
function evenNumbers(low: number, high: number): number[] {
  const widest = (high - low) / LEAST_PARTS;
  const power = Math.floor(Math.log10(widest));
  const lead = [5, 2, 1].find((count) => count * 10 ** power <= widest) ?? 1;
  const step = lead * 10 ** power;
  const first = Math.ceil(low / step);
  const count = Math.floor(high / step) - first + 1;
  return Array.from({ length: count }, (_, at) => Number(((first + at) * step).toPrecision(12)));
}

/**
 * The lines that carry numbers, null for all others: powers of ten, and their doubles and fives where there is room;
 * where those are fewer than two, every line that is not too near a number.
 * @param decade how wide a power of ten is drawn [px]
 */
export function numbered(splits: readonly number[], decade: number): (number | null)[] {
  const leads = decade > WIDE_DECADE ? /^[125]e/ : /^1e/;
  const chosen = splits.filter((value) => leads.test(value.toExponential()));
  if (chosen.length < 2) {
    const isFree = (value: number): boolean =>
      chosen.every((other) => decade * Math.abs(Math.log10(value / other)) >= NUMBER_SPACE);
    for (const value of splits) if (isFree(value)) chosen.push(value);
  }
  return splits.map((value) => (chosen.includes(value) ? value : null));
}
