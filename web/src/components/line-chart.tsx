/** Curves on a canvas (uPlot), with a cursor shared by all charts of the page. */
import 'uplot/dist/uPlot.min.css';
import { useElementSize } from '@mantine/hooks';
import { type KeyboardEvent, useEffect, useRef, useState } from 'react';
import uPlot from 'uplot';
import { readChartKey } from '@/components/line-chart-keys';
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

/** What the keys do, for those who cannot see it. */
const KEYS_HELP = 'Left and right arrow step through the points, plus and minus zoom, 0 shows all.';

export function LineChart(props: Props) {
  const { x, lines, range, scheme, isSmoothed, isShare, height, description, marks, ghosts, formatX } = props;
  const { ref: frame, width } = useElementSize();
  const canvas = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot>(null);
  // The plot outlives many renders, so it reads what is current through this.
  const now = useRef(props);
  now.current = props;
  const [at, setAt] = useState<number | null>(null);
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

  const press = (event: KeyboardEvent): void => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const wish = readChartKey(event.key, event.shiftKey, { ...props, at });
    if (wish === undefined) return;
    event.preventDefault();
    if (wish.range !== undefined) props.onZoom(wish.range);
    if (wish.at !== undefined) setAt(wish.at);
  };
  // biome-ignore lint/correctness/useExhaustiveDependencies: the plot itself is no state
  useEffect(() => {
    const place = at === null ? undefined : x[at];
    // The plot takes a new window in a microtask of its own; only behind that does the cursor find its place.
    if (place !== undefined) queueMicrotask(() => pointAt(plot.current, place));
  }, [at, range[0], range[1]]);
  const shown = at ?? x.length - 1;

  return (
    <div ref={frame} className={classes.frame} style={{ height }}>
      <div
        ref={canvas}
        className={classes.plot}
        role="slider"
        tabIndex={0}
        aria-label={description}
        aria-description={KEYS_HELP}
        aria-valuemin={0}
        aria-valuemax={Math.max(0, x.length - 1)}
        aria-valuenow={Math.max(0, shown)}
        aria-valuetext={shown >= 0 ? props.describePoint(shown) : 'no points yet'}
        onKeyDown={press}
        onBlur={() => {
          if (at !== null) pointAt(plot.current, null);
          setAt(null);
        }}
      />
    </div>
  );
}

/** Put the cursor at a place of the x axis, or nowhere, in this chart and in those that share it. */
function pointAt(plot: uPlot | null, place: number | null): void {
  if (plot === null) return;
  const setCursor = plot.setCursor as (at: { left: number; top: number }, fire: boolean, share: boolean) => void;
  const top = plot.over.clientHeight / 2;
  setCursor(place === null ? NOWHERE : { left: plot.valToPos(place, 'x'), top }, true, true);
}

/** Where uPlot draws no cursor [px]. */
const NOWHERE = { left: -10, top: -10 };

function dataOf({ x, lines, isSmoothed }: Props): uPlot.AlignedData {
  const columns = isSmoothed
    ? [...lines.map((line) => line.raw), ...lines.map((line) => line.smoothed)]
    : lines.map((line) => line.raw);
  return [x, ...columns] as unknown as uPlot.AlignedData;
}
