import { expect, test } from 'vitest';
import type { MetricBatch } from '@/client/schema.gen';
import { mergeMetrics, NO_METRICS } from '@/lib/metrics';
import { attemptMarks, chartGhosts } from './attempt-marks';
import { successChart } from './charts';

const steps = [1, 2, 3, 2, 3, 2, 3, 4];
const batch: MetricBatch = {
  cursor: 8,
  attempt: [1, 1, 1, 2, 2, 3, 3, 3],
  step: steps,
  epoch: steps,
  env_steps: steps.map((step) => 100 * step),
  episodes: steps,
  updates: steps,
  wall_seconds: steps,
  values: { 'test/success_rate': [0.1, 0.2, 0.3, null, 0.4, 0.5, 0.6, 0.7] },
};
const metrics = mergeMetrics(NO_METRICS, batch);
const envSteps = (part: MetricBatch): readonly number[] => part.env_steps;

test('attempts that began at the same place share a mark', () => {
  expect(attemptMarks(metrics, envSteps)).toEqual([{ x: 200, label: 'attempts 2, 3' }]);
});

test('each replaced stretch is a ghost of its line', () => {
  const ghosts = chartGhosts(metrics, successChart(['test/success_rate']), envSteps);
  expect(ghosts).toEqual([
    { line: 0, x: [100, 200, 300], y: [0.1, 0.2, 0.3] },
    { line: 0, x: [100, 200, 300], y: [0.1, null, 0.4] },
  ]);
});

test('a metric that was not logged has no ghost', () => {
  expect(chartGhosts(metrics, successChart(['train/success_rate']), envSteps)).toEqual([]);
});
