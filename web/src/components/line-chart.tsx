/** Curves on a canvas (uPlot), with a cursor shared by all charts of the page. */
import 'uplot/dist/uPlot.min.css';
import { useElementSize } from '@mantine/hooks';
import { useEffect, useRef } from 'react';
import uPlot from 'uplot';
import { ChartSlider } from '@/components/chart-slider';
import { type ChartLook, chartOptions } from '@/components/line-chart-options';
import type { Scheme } from '@/lib/palette';
import classes from './line-chart.module.css';

export type Column = readonly (number | null)[];

/** One curve: its points as logged, and smoothed. */
export interface Line {
  readonly label: string;
  readonly raw: Column;
  readonly smoothed: Column;
}

interface Props extends ChartLook {
  x: readonly number[];
  lines: readonly Line[];
  /** What is shown of the x axis. */
  range: readonly [number, number];
  /** All that there is of the x axis. */
  whole: readonly [number, number];
  scheme: Scheme;
  /** Called with the place of the cursor among the points, null when it has left. */
  onPoint: (at: number | null) => void;
  /** Called with the part chosen by dragging, null to show all again. */
  onZoom: (range: readonly [number, number] | null) => void;
  /** What the chart shows, in a sentence. */
  description: string;
  /** The values at one of the points, in words. */
  describePoint: (at: number) => string;
}

export function LineChart(props: Props) {
  const { x, lines, range, scheme, isSmoothed, isShare, height, marks, ghosts, formatX } = props;
  const { ref: frame, width } = useElementSize();
  const canvas = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot>(null);
  // The plot outlives many renders, so it reads what is current through this.
  const now = useRef(props);
  now.current = props;
  const labels = lines.map((line) => line.label).join('\n');

  // biome-ignore lint/correctness/useExhaustiveDependencies: a new plot is made only when its look changes
  useEffect(() => {
    if (canvas.current === null || width === 0) return;
    const made = new uPlot(
      chartOptions(() => now.current, width),
      dataOf(now.current),
      canvas.current,
    );
    plot.current = made;
    return () => {
      plot.current = null;
      made.destroy();
    };
  }, [labels, scheme, isSmoothed, isShare, width, height, formatX]);

  // biome-ignore lint/correctness/useExhaustiveDependencies: these are what dataOf and the options read
  useEffect(() => {
    plot.current?.setData(dataOf(now.current), true);
  }, [x, lines, range[0], range[1], marks, ghosts]);

  return (
    <div ref={frame} className={classes.frame} style={{ height }}>
      <ChartSlider
        canvas={canvas}
        plot={plot}
        x={x}
        range={range}
        whole={props.whole}
        onZoom={props.onZoom}
        description={props.description}
        describePoint={props.describePoint}
      />
    </div>
  );
}

function dataOf({ x, lines, isSmoothed }: Props): uPlot.AlignedData {
  const columns = isSmoothed
    ? [...lines.map((line) => line.raw), ...lines.map((line) => line.smoothed)]
    : lines.map((line) => line.raw);
  return [x, ...columns] as unknown as uPlot.AlignedData;
}
