/** How a chart below a 3D view is drawn. */
import type uPlot from 'uplot';
import { lineStyle, type Scheme } from '@/lib/palette';
import type { TimelineChart } from '@/lib/timelines';

/** Height of one chart [px]. */
const HEIGHT = 92;

/** Contacts need less: they are yes or no [px]. */
const LOW_HEIGHT = 62;

const INK: Record<Scheme, { text: string; grid: string }> = {
  light: { text: '#5c6370', grid: '#eceef1' },
  dark: { text: '#9ba3af', grid: '#262b32' },
};

export function timelineOptions(chart: TimelineChart, steps: number, scheme: Scheme, width: number): uPlot.Options {
  const isContact = chart.group === 'contact';
  const axis: uPlot.Axis = {
    stroke: INK[scheme].text,
    font: '11px system-ui, sans-serif',
    grid: { stroke: INK[scheme].grid, width: 1 },
    ticks: { show: false },
  };
  return {
    width,
    height: isContact ? LOW_HEIGHT : HEIGHT,
    padding: [6, 14, 0, 0],
    legend: { show: false },
    scales: { x: { time: false, range: [0, steps] }, ...(isContact && { y: { range: [-0.1, 1.1] } }) },
    axes: [
      { ...axis, size: 20, gap: 2, space: 50 },
      {
        ...axis,
        size: 44,
        gap: 4,
        space: 24,
        ...(isContact && { splits: [0, 1], values: () => ['no', 'yes'] }),
      },
    ],
    series: [
      {},
      ...chart.curves.map(({ label }, at): uPlot.Series => {
        const { color, dash } = lineStyle(at, scheme);
        return { label, stroke: color, dash: [...dash], width: 1.75, points: { show: false } };
      }),
    ],
    cursor: { y: false, points: { show: false }, drag: { x: false, y: false } },
  };
}
