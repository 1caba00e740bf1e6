/** The surface of a chart: it takes the keyboard, and tells those who cannot see it what stands at the cursor. */
import { type KeyboardEvent, type MouseEvent, type RefObject, useEffect, useState } from 'react';
import type uPlot from 'uplot';
import { pointAt } from '@/components/chart-cursor';
import { readChartKey } from '@/components/line-chart-keys';
import type { Range } from '@/lib/zoom';
import classes from './line-chart.module.css';

interface Props {
  /** Where the plot is put. */
  canvas: RefObject<HTMLDivElement | null>;
  plot: RefObject<uPlot | null>;
  x: readonly number[];
  /** What is shown of the x axis, and all there is of it. */
  range: Range;
  whole: Range;
  onZoom: (range: Range | null) => void;
  onClick?: (event: MouseEvent) => void;
  /** What the chart shows, in a sentence. */
  description: string;
  /** The values at one of the points, in words. */
  describePoint: (at: number) => string;
}

/** What the keys do, for those who cannot see it. */
const KEYS_HELP = 'Left and right arrow step through the points, plus and minus zoom, 0 shows all.';

export function ChartSlider({ canvas, plot, x, range, whole, onZoom, onClick, description, describePoint }: Props) {
  // The place is kept, not its number: a live curve may get points before it.
  const [place, setPlace] = useState<number | null>(null);
  const at = place === null ? null : pointNear(x, place);
  const press = (event: KeyboardEvent): void => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const wish = readChartKey(event.key, event.shiftKey, { x, at, range, whole });
    if (wish === undefined) return;
    event.preventDefault();
    if (wish.range !== undefined) onZoom(wish.range);
    if (wish.at !== undefined) setPlace(x[wish.at] ?? null);
  };
  // biome-ignore lint/correctness/useExhaustiveDependencies: the plot itself is no state
  useEffect(() => {
    // The plot takes a new window in a microtask of its own; only behind that does the cursor find its place.
    if (place !== null) queueMicrotask(() => pointAt(plot.current, place));
  }, [place, range[0], range[1]]);
  const shown = at ?? x.length - 1;
  return (
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
      aria-valuetext={shown >= 0 ? describePoint(shown) : 'no points yet'}
      onKeyDown={press}
      onClick={onClick}
      onBlur={() => {
        if (place !== null) pointAt(plot.current, null);
        setPlace(null);
      }}
    />
  );
}

/** The number of the last point at or before a place; the first one where there is none. */
function pointNear(x: readonly number[], place: number): number {
  return Math.max(
    0,
    x.findLastIndex((point) => point <= place),
  );
}
