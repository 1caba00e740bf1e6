/** A metric as a column: its newest value, its best, or the mean of its last ones. The server writes it the same way. */
import { formatShare, formatValue } from '@/lib/format';

export interface MetricColumn {
  readonly name: string;
  readonly statistic: 'last' | 'best' | 'mean';
  /** Newest values that a mean is taken over. */
  readonly window: number;
}

/** A mean is taken over at most so many values. */
export const LONGEST_WINDOW = 20;

const WRITTEN = /^([^:,]{1,200}):(?:(last|best)|mean(\d{1,2}))$/;

/** Read `test/success_rate:mean5` and the like; null if it is none. */
export function parseMetricColumn(text: string): MetricColumn | null {
  const [, name, statistic, window] = WRITTEN.exec(text) ?? [];
  if (name === undefined) return null;
  const values = Number(window ?? 1);
  if (values < 1 || values > LONGEST_WINDOW) return null;
  return { name, statistic: statistic === 'last' || statistic === 'best' ? statistic : 'mean', window: values };
}

export function isMetricColumn(text: string): boolean {
  return parseMetricColumn(text) !== null;
}

export function writeMetricColumn({ name, statistic, window }: MetricColumn): string {
  return `${name}:${statistic}${statistic === 'mean' ? window : ''}`;
}

/** What is wanted of the metric, in words: `best`, `mean of last 5`. */
export function statisticName({ statistic, window }: Pick<MetricColumn, 'statistic' | 'window'>): string {
  return statistic === 'mean' ? `mean of last ${window}` : statistic;
}

/** A value of the metric as text; shares in percent. */
export function formatMetric(name: string, value: number | null | undefined): string {
  return /(success_rate|_share|fraction)$/.test(name) ? formatShare(value, 1) : formatValue(value);
}
