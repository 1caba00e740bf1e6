/** One chart below a 3D view; it shares the view's cursor: the line follows the scene, a click sends the scene there. */
import 'uplot/dist/uPlot.min.css';
import { useElementSize } from '@mantine/hooks';
import { type PointerEvent, useEffect, useRef } from 'react';
import uPlot from 'uplot';
import { lineStyle, type Scheme } from '@/lib/palette';
import { formatTimelineValue, type TimelineChart } from '@/lib/timelines';
import classes from './scene.module.css';
import { timelineOptions } from './timeline-options';

interface Props {
  chart: TimelineChart;
  step: number;
  steps: number;
  scheme: Scheme;
  onSeek: (step: number) => void;
}

export function TimelineChartView({ chart, step, steps, scheme, onSeek }: Props) {
  const { ref: frame, width } = useElementSize();
  const canvas = useRef<HTMLDivElement>(null);
  const line = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot>(null);
  const now = useRef({ chart, step });
  now.current = { chart, step };
  const labels = chart.curves.map(({ label }) => label).join('\n');

  // biome-ignore lint/correctness/useExhaustiveDependencies: a new plot is made only when its look changes
  useEffect(() => {
    if (canvas.current === null || width === 0) return;
    const made = new uPlot(
      timelineOptions(chart, steps, scheme, width),
      dataOf(now.current.chart, steps),
      canvas.current,
    );
    plot.current = made;
    placeLine(made, line.current, now.current.step);
    return () => {
      plot.current = null;
      made.destroy();
    };
  }, [labels, chart.group, steps, scheme, width]);
  useEffect(() => plot.current?.setData(dataOf(chart, steps)), [chart, steps]);
  useEffect(() => placeLine(plot.current, line.current, step), [step]);

  const seek = (event: PointerEvent): void => {
    const over = plot.current?.over;
    if (plot.current === null || over === undefined || event.buttons !== 1) return;
    const place = plot.current.posToVal(event.clientX - over.getBoundingClientRect().left, 'x');
    onSeek(Math.min(steps, Math.max(0, Math.round(place))));
  };
  return (
    <figure className={classes.timeline} aria-label={chart.title} data-group={chart.group}>
      <figcaption>
        <h3>{chart.title}</h3>
        {chart.curves.map(({ label, values }, at) => (
          <CurveKey
            key={label}
            at={at}
            label={label}
            value={formatTimelineValue(chart, values[step])}
            scheme={scheme}
          />
        ))}
      </figcaption>
      <div ref={frame} className={classes.plot} onPointerDown={seek} onPointerMove={seek}>
        <div ref={canvas} />
        <div ref={line} className={classes.now} />
      </div>
    </figure>
  );
}

function CurveKey({ at, label, value, scheme }: { at: number; label: string; value: string; scheme: Scheme }) {
  const { color, dash } = lineStyle(at, scheme);
  return (
    <span className={classes.key}>
      <svg width="18" height="8" aria-hidden="true">
        <path d="M0 4h18" stroke={color} strokeWidth="2" strokeDasharray={dash.join(' ')} />
      </svg>
      {label} <b className="number">{value}</b>
    </span>
  );
}

/** Put the cursor's line to a step. */
function placeLine(plot: uPlot | null, line: HTMLDivElement | null, step: number): void {
  if (plot === null || line === null) return;
  const left = plot.over.offsetLeft + plot.valToPos(step, 'x');
  line.style.transform = `translateX(${left}px)`;
  line.style.height = `${plot.over.clientHeight}px`;
  line.style.top = `${plot.over.offsetTop}px`;
}

/** Columns of one length: values of transitions end one step before those of moments, unknown ones are missing. */
function dataOf(chart: TimelineChart, steps: number): uPlot.AlignedData {
  const x = Array.from({ length: steps + 1 }, (_, step) => step);
  return [x, ...chart.curves.map(({ values }) => x.map((step) => values[step] ?? null))] as uPlot.AlignedData;
}
