import { expect, test } from 'vitest';
import type { MetricBatch } from '@/client/schema.gen';
import { attemptStarts, mergeMetrics, NO_METRICS, newestValue } from '@/lib/metrics';

function batch(cursor: number, steps: number[], values: MetricBatch['values'], attempt = 1): MetricBatch {
  return {
    cursor,
    attempt: steps.map(() => attempt),
    step: steps,
    epoch: steps,
    env_steps: steps.map((step) => step * 1900),
    episodes: steps,
    updates: steps,
    wall_seconds: steps,
    values,
  };
}

test('a batch is put behind what is known', () => {
  const first = mergeMetrics(NO_METRICS, batch(2, [1, 2], { 'a/x': [0.1, 0.2] }));
  const both = mergeMetrics(first, batch(3, [3], { 'a/x': [0.3] }));
  expect(both.step).toEqual([1, 2, 3]);
  expect(both.values['a/x']).toEqual([0.1, 0.2, 0.3]);
  expect(both.cursor).toBe(3);
});

test('a metric that comes or stays away later leaves gaps', () => {
  const first = mergeMetrics(NO_METRICS, batch(1, [1], { 'a/x': [1] }));
  const both = mergeMetrics(first, batch(2, [2], { 'b/y': [2] }));
  expect(both.values['a/x']).toEqual([1, null]);
  expect(both.values['b/y']).toEqual([null, 2]);
});

test('a later attempt replaces the points from its first step on', () => {
  const first = mergeMetrics(NO_METRICS, batch(4, [1, 2, 3, 4], { 'a/x': [1, 2, 3, 4] }));
  const both = mergeMetrics(first, batch(6, [3, 4], { 'a/x': [30, 40] }, 2));
  expect(both.step).toEqual([1, 2, 3, 4]);
  expect(both.values['a/x']).toEqual([1, 2, 30, 40]);
  expect(both.attempt).toEqual([1, 1, 2, 2]);
});

test('what was replaced is kept, from the point where the curve left it', () => {
  const first = mergeMetrics(NO_METRICS, batch(4, [1, 2, 3, 4], { 'a/x': [1, 2, 3, 4] }));
  const both = mergeMetrics(first, batch(6, [3, 4], { 'a/x': [30, 40] }, 2));
  expect(both.replaced.map((part) => part.values['a/x'])).toEqual([[2, 3, 4]]);
  expect(both.replaced[0]?.step).toEqual([2, 3, 4]);
});

test('a batch that holds several attempts is cut between them', () => {
  const mixed = { ...batch(5, [1, 2, 3, 2, 3], { 'a/x': [1, 2, 3, 20, 30] }), attempt: [1, 1, 1, 2, 2] };
  const known = mergeMetrics(NO_METRICS, mixed);
  expect(known.values['a/x']).toEqual([1, 20, 30]);
  expect(known.replaced.map((part) => part.values['a/x'])).toEqual([[1, 2, 3]]);
});

test('each later attempt has a start, also one that was replaced in turn', () => {
  const steps = [1, 2, 3, 2, 3, 2, 3, 4];
  const mixed = { ...batch(8, steps, {}), attempt: [1, 1, 1, 2, 2, 3, 3, 3] };
  const starts = attemptStarts(mergeMetrics(NO_METRICS, mixed));
  expect(starts.map(({ attempt, part, row }) => [attempt, part.step[row]])).toEqual([
    [2, 2],
    [3, 2],
  ]);
});

test('an attempt of which only the end was replaced began where it began', () => {
  const steps = [1, 2, 3, 4, 3, 4, 5, 6, 5, 6];
  const mixed = { ...batch(10, steps, {}), attempt: [1, 1, 1, 1, 2, 2, 2, 2, 3, 3] };
  const starts = attemptStarts(mergeMetrics(NO_METRICS, mixed));
  expect(starts.map(({ attempt, part, row }) => [attempt, part.step[row]])).toEqual([
    [2, 3],
    [3, 5],
  ]);
});

test('an attempt that goes on without a gap replaces nothing', () => {
  const first = mergeMetrics(NO_METRICS, batch(2, [1, 2], {}));
  const both = mergeMetrics(first, batch(4, [3, 4], {}, 2));
  expect(both.replaced).toEqual([]);
  expect(attemptStarts(both).map(({ attempt, row }) => [attempt, row])).toEqual([[2, 2]]);
});

test('an empty batch changes nothing', () => {
  const known = mergeMetrics(NO_METRICS, batch(1, [1], { 'a/x': [1] }));
  expect(mergeMetrics(known, batch(1, [], {}))).toBe(known);
});

test('the newest value skips gaps', () => {
  expect(newestValue([0.1, 0.4, null])).toBe(0.4);
  expect(newestValue([null])).toBeNull();
});
