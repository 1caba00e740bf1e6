/** Which charts a run has, and the points that each draws. */
import type { MetricBatch } from '@/client/schema.gen';
import { isShare } from '@/lib/axes';
import { formatName, formatShare, formatValue } from '@/lib/format';
import type { Metrics } from '@/lib/metrics';
import { smooth } from '@/lib/smoothing';
import type { Axis } from './search';

/** One line of a chart: a metric, and what the legend calls it. */
export interface Series {
  readonly metric: string;
  readonly label: string;
}

export interface ChartSpec {
  readonly id: string;
  readonly title: string;
  readonly series: readonly Series[];
  /** Whether the values are shares from 0 to 1. */
  readonly isShare: boolean;
}

export interface ChartSection {
  readonly name: string;
  readonly charts: readonly ChartSpec[];
}

const SUCCESS: readonly Series[] = [
  { metric: 'test/success_rate', label: 'test' },
  { metric: 'train/success_rate', label: 'train' },
];

/** Sections in this order; what is not named comes between, by the alphabet. */
const FIRST = ['test', 'train'];
const LAST = ['speed', 'progress'];

/** The chart that matters most: how often the task succeeds. */
export function successChart(names: readonly string[]): ChartSpec {
  const series = SUCCESS.filter(({ metric }) => names.includes(metric));
  return { id: 'success', title: 'Success rate', series, isShare: true };
}

/** Group the other metrics by what stands before the first slash; `critic/<stream>/loss` are lines of one chart. */
export function chartSections(names: readonly string[]): ChartSection[] {
  const sections = new Map<string, Map<string, Series[]>>();
  const shown = new Set(SUCCESS.map(({ metric }) => metric));
  for (const metric of [...names].sort()) {
    // How episodes ended is one stacked chart, among the episodes themselves.
    if (shown.has(metric) || metric.startsWith('episodes/')) continue;
    const parts = metric.split('/');
    const section = parts.length > 1 ? (parts[0] ?? '') : 'other';
    const last = parts.at(-1) ?? metric;
    const charts = sections.get(section) ?? new Map<string, Series[]>();
    sections.set(section, charts);
    charts.set(last, [...(charts.get(last) ?? []), { metric, label: parts.slice(1, -1).join('/') || last }]);
  }
  return [...sections]
    .map(([name, charts]) => ({
      name,
      charts: [...charts].map(([last, series]) => ({
        id: `${name}/${last}`,
        title: formatName(last),
        series,
        isShare: isShare(last),
      })),
    }))
    .sort((one, other) => rank(one.name) - rank(other.name) || one.name.localeCompare(other.name));
}

function rank(section: string): number {
  if (FIRST.includes(section)) return FIRST.indexOf(section);
  return LAST.includes(section) ? 200 + LAST.indexOf(section) : 100;
}

/** Where each point lies on the x axis. */
export function xColumn(metrics: MetricBatch, axis: Axis, cyclesPerEpoch: number): readonly number[] {
  // Epochs are whole numbers; between them the cycles tell the points apart.
  return axis === 'epoch' ? metrics.step.map((step) => step / cyclesPerEpoch) : metrics[axis];
}

/** The points of one chart: rows in which at least one line has a value. */
export interface ChartPoints {
  readonly x: readonly number[];
  readonly raw: readonly (readonly (number | null)[])[];
  readonly smoothed: readonly (readonly (number | null)[])[];
  /** Row of each point in the run's metrics. */
  readonly rows: readonly number[];
}

export function chartPoints(metrics: Metrics, x: readonly number[], chart: ChartSpec, weight: number): ChartPoints {
  const columns = chart.series.map(({ metric }) => metrics.values[metric] ?? []);
  const rows = x.flatMap((_, row) => (columns.some((column) => (column[row] ?? null) !== null) ? [row] : []));
  const steps = rows.map((row) => metrics.step[row] ?? 0);
  const raw = columns.map((column) => rows.map((row) => column[row] ?? null));
  return { x: rows.map((row) => x[row] ?? 0), raw, smoothed: raw.map((column) => smooth(column, steps, weight)), rows };
}

/** A value of a chart as text. */
export function formatY(chart: ChartSpec, value: number | null): string {
  return chart.isShare ? formatShare(value, 1) : formatValue(value);
}
