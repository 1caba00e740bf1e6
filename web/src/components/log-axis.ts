/** Where the lines and the numbers of a logarithmic axis stand. */
import type uPlot from 'uplot';

/** Below this width of a power of ten only the powers themselves carry numbers [px]. */
const WIDE_DECADE = 110;

/** What uPlot is to do otherwise on a logarithmic axis: its own lines begin at the end of the axis, not at round numbers. */
export function logAxis(scale: 'x' | 'y'): Pick<uPlot.Axis, 'splits' | 'filter'> {
  return {
    splits: (_plot, _axis, low, high) => roundNumbers(low, high),
    filter: (plot, splits) => {
      const decade = Math.abs(plot.valToPos(10, scale) - plot.valToPos(1, scale));
      return numbered(splits, decade > WIDE_DECADE);
    },
  };
}

/** One to nine times every power of ten, as far as they lie on the axis. */
export function roundNumbers(low: number, high: number): number[] {
  const found: number[] = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); power += 1) {
    for (let lead = 1; lead < 10; lead += 1) {
      const value = Number(`${lead}e${power}`);
      if (value >= low && value <= high) found.push(value);
    }
  }
  return found;
}

/** Powers of ten, and their doubles and fives where there is room; null for all others. */
export function numbered(splits: readonly number[], isWide: boolean): (number | null)[] {
  const leads = isWide ? '125' : '1';
  return splits.map((value) => (leads.includes(value.toExponential().charAt(0)) ? value : null));
}
