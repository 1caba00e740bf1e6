import { expect, test } from 'vitest';
import { mergeMetrics, NO_METRICS } from '@/lib/metrics';
import { chartPoints, chartSections, successChart, xColumn } from './charts';

const NAMES = [
  'speed/env_steps_per_s',
  'critic/task/loss',
  'critic/sldr/object0/loss',
  'test/success_rate',
  'train/success_rate',
  'test/best_success_rate',
];

const metrics = mergeMetrics(NO_METRICS, {
  cursor: 3,
  attempt: [1, 1, 1],
  step: [1, 2, 3],
  epoch: [1, 1, 2],
  env_steps: [10, 20, 30],
  episodes: [1, 2, 3],
  updates: [4, 8, 12],
  wall_seconds: [1.5, 3, 4.5],
  values: { 'test/success_rate': [null, 0.5, null], 'train/success_rate': [0.1, null, null], 'a/b': [1, 2, 3] },
});

test('the success chart has test first, then train', () => {
  expect(successChart(NAMES).series.map((series) => series.label)).toEqual(['test', 'train']);
});

test('the other metrics are grouped by prefix, streams as lines of one chart, speed last', () => {
  const sections = chartSections(NAMES);
  expect(sections.map((section) => section.name)).toEqual(['test', 'critic', 'speed']);
  expect(sections[1]?.charts[0]?.series.map((series) => series.label)).toEqual(['sldr/object0', 'task']);
});

test('between epochs the cycles tell the points apart', () => {
  expect(xColumn(metrics, 'epoch', 2)).toEqual([0.5, 1, 1.5]);
  expect(xColumn(metrics, 'wall_seconds', 2)).toEqual([1.5, 3, 4.5]);
});

test('rows in which a chart has no value are left out', () => {
  const points = chartPoints(metrics, xColumn(metrics, 'env_steps', 2), successChart(Object.keys(metrics.values)), 0);
  expect(points.x).toEqual([10, 20]);
  expect(points.raw).toEqual([
    [null, 0.5],
    [0.1, null],
  ]);
});
