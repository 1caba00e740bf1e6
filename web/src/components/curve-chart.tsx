/** Curves of many runs on a canvas (uPlot): a band and a centre for each group, or every seed. */
import 'uplot/dist/uPlot.min.css';
import { useElementSize } from '@mantine/hooks';
import { useEffect, useMemo, useRef } from 'react';
import uPlot from 'uplot';
import { ChartSlider } from '@/components/chart-slider';
import { type CurveChartLook, type CurveChartState, curveChartOptions, near } from '@/components/curve-chart-options';
import { type Curve, type Emphasis, placesOf } from '@/lib/curves';
import type { Scheme } from '@/lib/palette';
import type { Range } from '@/lib/zoom';
import classes from './line-chart.module.css';

interface Props extends CurveChartLook {
  curves: readonly Curve[];
  /** Whether the curves are smoothed, with the computed points faded behind them. */
  isSmoothed: boolean;
  emphasis: Emphasis | null;
  /** What is shown of the x axis, and all there is of it. */
  range: Range;
  whole: Range;
  yRange: Range;
  scheme: Scheme;
  /** Called with the x under the cursor and whether the mouse is in this very chart; null when it has left. */
  onPoint: (place: number | null, isHere: boolean) => void;
  onZoom: (range: Range | null) => void;
  /** Called with the curve that the mouse is near, null when there is none. */
  onNear: (emphasis: Emphasis | null) => void;
  /** Called with the curve that was clicked. */
  onPick: (emphasis: Emphasis) => void;
  description: string;
  /** The values at a place of the x axis, in words. */
  describePlace: (place: number) => string;
}

export function CurveChart(props: Props) {
  const { curves, range, yRange, scheme, height, isLogX, isLogY, isSmoothed, emphasis, formatX, formatY } = props;
  const { ref: frame, width } = useElementSize();
  const canvas = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot>(null);
  const places = useMemo(() => placesOf(curves).filter((place) => !isLogX || place > 0), [curves, isLogX]);
  const state: CurveChartState = {
    ...props,
    onPoint: (at) => props.onPoint(at === null ? null : (places[at] ?? null), isHere(plot.current, canvas.current)),
  };
  // The plot outlives many renders, so it reads what is current through this.
  const now = useRef(state);
  now.current = state;

  // biome-ignore lint/correctness/useExhaustiveDependencies: a new plot is made only when its look changes
  useEffect(() => {
    if (canvas.current === null || width === 0) return;
    const options = curveChartOptions(() => now.current, width);
    const made = new uPlot(options, dataOf(places), canvas.current);
    plot.current = made;
    return () => {
      plot.current = null;
      made.destroy();
    };
  }, [scheme, isLogX, isLogY, width, height, formatX, formatY]);

  // biome-ignore lint/correctness/useExhaustiveDependencies: these are what the options read
  useEffect(() => {
    plot.current?.setData(dataOf(places), true);
  }, [places, range[0], range[1], yRange[0], yRange[1]]);

  // biome-ignore lint/correctness/useExhaustiveDependencies: these are what is painted
  useEffect(() => {
    plot.current?.redraw(false, false);
  }, [curves, isSmoothed, emphasis?.key, emphasis?.runId]);

  return (
    <div ref={frame} className={classes.frame} style={{ height }}>
      <ChartSlider
        canvas={canvas}
        plot={plot}
        x={places}
        range={range}
        whole={props.whole}
        onZoom={props.onZoom}
        onClick={() => {
          const picked = plot.current && near(plot.current, now.current);
          if (picked) props.onPick(picked);
        }}
        description={props.description}
        describePoint={(at) => props.describePlace(places[at] ?? 0)}
      />
    </div>
  );
}

/** Whether the mouse or the keyboard is in this very chart, and not in one that shares its cursor. */
function isHere(plot: uPlot | null, canvas: HTMLDivElement | null): boolean {
  return plot?.over.matches(':hover') === true || canvas?.matches(':focus-visible') === true;
}

function dataOf(places: readonly number[]): uPlot.AlignedData {
  return [places, places.map(() => null)] as unknown as uPlot.AlignedData;
}
