/** How a chart is drawn and what the mouse does in it. */
import type uPlot from 'uplot';
import { axisLook, sharedCursor, zoomToSelection } from '@/components/chart-cursor';
import { drawGhosts, drawMarks, type Ghost, type Mark, withGhosts } from '@/components/line-chart-marks';
import { CHART_INK, lineStyle, type Scheme } from '@/lib/palette';

/** What decides how a chart looks, beside its points. */
export interface ChartLook {
  readonly height: number;
  readonly isShare: boolean;
  /** Whether smoothed curves are drawn, with the logged points faded behind them. */
  readonly isSmoothed: boolean;
  /** Distances that ticks of the x axis may have; uPlot's own if left out. */
  readonly xSteps?: readonly number[];
  /** With the distance of the ticks, they read differently. */
  readonly formatX: (value: number, step?: number) => string;
  readonly formatY: (value: number) => string;
  /** Places on the x axis where a later attempt began. */
  readonly marks: readonly Mark[];
  /** Stretches of the lines that a later attempt replaced. */
  readonly ghosts: readonly Ghost[];
}

interface Current extends ChartLook {
  readonly lines: readonly { readonly label: string; readonly raw: readonly (number | null)[] }[];
  readonly range: readonly [number, number];
  readonly scheme: Scheme;
  readonly onPoint: (at: number | null) => void;
  readonly onZoom: (range: readonly [number, number] | null) => void;
}

/** All charts of the page share the cursor of this name. */
const SHARED_CURSOR = 'run';
/** Points are drawn as dots up to this many. */
const MOST_DOTS = 120;
const FADED = '45';

/** Options for uPlot; what changes between renders is read through `now`. */
export function chartOptions(now: () => Current, width: number): uPlot.Options {
  const { height, isShare, lines, scheme, xSteps } = now();
  const axis = axisLook(scheme);
  return {
    width,
    height,
    padding: [8, 18, 0, 0],
    legend: { show: false },
    scales: {
      x: { time: false, range: () => [...now().range] as [number, number] },
      y: {
        range: (_plot, low, high) =>
          isShare ? [-0.02, 1.02] : padded(...withGhosts(low, high, now().ghosts, now().range)),
      },
    },
    axes: [
      {
        ...axis,
        size: 28,
        gap: 4,
        space: 64,
        ...(xSteps && { incrs: [...xSteps] }),
        values: (_plot, splits, _axis, _space, step) => splits.map((value) => now().formatX(value, step)),
      },
      { ...axis, size: 52, gap: 5, space: 28, values: (_plot, splits) => splits.map((value) => now().formatY(value)) },
    ],
    series: [{}, ...seriesOf(now(), lines.length)],
    cursor: sharedCursor(SHARED_CURSOR, (range) => now().onZoom(range)),
    hooks: {
      setCursor: [(plot) => now().onPoint(plot.cursor.idx ?? null)],
      setSelect: [(plot) => zoomToSelection(plot, now().onZoom)],
      drawAxes: [(plot) => drawGhosts(plot, now().ghosts, (line) => lineStyle(line, now().scheme).color)],
      draw: [(plot) => drawMarks(plot, now().marks, CHART_INK[scheme].mark)],
    },
  };
}

function seriesOf({ isSmoothed, scheme, lines }: Current, count: number): uPlot.Series[] {
  const styles = Array.from({ length: count }, (_, at) => lineStyle(at, scheme));
  const points: uPlot.Series.Points = {
    show: (plot, at) => (plot.data[at] ?? []).filter((value) => value !== null).length <= MOST_DOTS,
    size: 5,
  };
  const raw = styles.map(
    ({ color, dash }, at): uPlot.Series => ({
      label: lines[at]?.label,
      stroke: isSmoothed ? `${color}${FADED}` : color,
      width: isSmoothed ? 1 : 1.6,
      dash: isSmoothed ? [] : [...dash],
      spanGaps: true,
      points: isSmoothed ? { show: false } : points,
    }),
  );
  const smoothed = styles.map(
    ({ color, dash }): uPlot.Series => ({
      stroke: color,
      width: 2,
      dash: [...dash],
      spanGaps: true,
      points: { show: false },
    }),
  );
  return isSmoothed ? [...raw, ...smoothed] : raw;
}

function padded(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null) return [0, 1];
  const margin = (high - low) * 0.08 || Math.abs(high) * 0.1 || 1;
  // A curve that never falls below zero is drawn from zero when it comes near it.
  const bottom = low >= 0 && low - margin < (high - low) * 0.5 ? 0 : low - margin;
  return [bottom, high + margin];
}
