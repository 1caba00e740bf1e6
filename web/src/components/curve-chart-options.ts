/** How a chart of many runs' curves is drawn, and what the mouse does in it. */
import type uPlot from 'uplot';
import { axisLook, sharedCursor, zoomToSelection } from '@/components/chart-cursor';
import { drawCurves } from '@/components/curve-chart-draw';
import { logAxis } from '@/components/log-axis';
import { type Curve, type Emphasis, nearestCurve } from '@/lib/curves';
import type { Scheme } from '@/lib/palette';
import type { Range } from '@/lib/zoom';

/** What decides how such a chart looks, beside its curves. */
export interface CurveChartLook {
  readonly height: number;
  readonly isLogX: boolean;
  readonly isLogY: boolean;
  /** Distances that ticks of the x axis may have; uPlot's own if left out. */
  readonly xSteps?: readonly number[];
  /** With the distance of the ticks, they read differently. */
  readonly formatX: (value: number, step?: number) => string;
  readonly formatY: (value: number) => string;
}

/** What the plot reads anew each time it draws or is pointed at. */
export interface CurveChartState extends CurveChartLook {
  readonly curves: readonly Curve[];
  readonly isSmoothed: boolean;
  readonly emphasis: Emphasis | null;
  readonly range: Range;
  readonly yRange: Range;
  readonly scheme: Scheme;
  /** Called with the row of `placesOf(curves)` under the cursor. */
  readonly onPoint: (at: number | null) => void;
  readonly onZoom: (range: Range | null) => void;
  readonly onNear: (emphasis: Emphasis | null) => void;
}

/** All charts of the page share the cursor of this name. */
const SHARED_CURSOR = 'compare';
/** The mouse takes hold of curves this near [px]. */
const REACH = 26;

/** Options for uPlot; what changes between renders is read through `now`. */
export function curveChartOptions(now: () => CurveChartState, width: number): uPlot.Options {
  const { height, isLogX, isLogY, scheme, xSteps } = now();
  const axis = axisLook(scheme);
  return {
    width,
    height,
    padding: [8, 14, 0, 0],
    legend: { show: false },
    scales: {
      x: { time: false, distr: isLogX ? 3 : 1, range: () => [...now().range] as [number, number] },
      y: { distr: isLogY ? 3 : 1, range: () => [...now().yRange] as [number, number] },
    },
    axes: [
      {
        ...axis,
        size: 26,
        gap: 4,
        space: 56,
        ...(xSteps && !isLogX && { incrs: [...xSteps] }),
        ...(isLogX && logAxis('x')),
        values: (_plot, splits, _axis, _space, step) =>
          splits.map((value) => (value === null ? '' : now().formatX(value, step))),
      },
      {
        ...axis,
        size: 48,
        gap: 5,
        space: 26,
        ...(isLogY && logAxis('y')),
        values: (_plot, splits) => splits.map((value) => (value === null ? '' : now().formatY(value))),
      },
    ],
    // The curves are painted by hand: the one series only tells the plot where there are points.
    series: [{}, { show: true, stroke: 'transparent', width: 0, points: { show: false } }],
    cursor: { ...sharedCursor(SHARED_CURSOR, (range) => now().onZoom(range)), points: { show: false } },
    hooks: {
      setCursor: [
        (plot) => {
          now().onPoint(plot.cursor.idx ?? null);
          // Only the chart under the mouse says which curve is near; the others follow.
          if (plot.over.matches(':hover')) now().onNear(near(plot, now()));
        },
      ],
      setSelect: [(plot) => zoomToSelection(plot, now().onZoom)],
      draw: [(plot) => drawCurves(plot, now().curves, now().emphasis, now().isLogY, now().isSmoothed)],
    },
  };
}

/** The curve near the cursor. */
export function near(plot: uPlot, { curves }: CurveChartState): Emphasis | null {
  const { left, top } = plot.cursor;
  if (left === undefined || top === undefined || left < 0 || top < 0) return null;
  return nearestCurve(curves, plot.posToVal(left, 'x'), top, (value) => plot.valToPos(value, 'y'), REACH);
}
