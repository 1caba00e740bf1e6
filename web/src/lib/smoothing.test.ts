import { expect, test } from 'vitest';
import { smooth } from '@/lib/smoothing';

test('without weight the curve stays as it is', () => {
  expect(smooth([1, 5, 2], [1, 2, 3], 0)).toEqual([1, 5, 2]);
});

test('the first point never moves', () => {
  expect(smooth([4, 0], [1, 2], 0.9)[0]).toBeCloseTo(4);
});

test('a constant curve stays constant', () => {
  for (const value of smooth([3, 3, 3, 3], [1, 2, 3, 4], 0.95)) expect(value).toBeCloseTo(3);
});

test('the mean leans on the past by its weight', () => {
  // (0.5 * 0.5 * 2 + 0.5 * 4) / (1 - 0.25)
  expect(smooth([2, 4], [1, 2], 0.5)[1]).toBeCloseTo(2.5 / 0.75);
});

test('gaps stay gaps and do not fade what came before', () => {
  const values = smooth([2, null, 4], [1, 2, 3], 0.5);
  expect(values[1]).toBeNull();
  expect(values[2]).toBeGreaterThan(3);
});

test('points far apart are hardly smoothed', () => {
  expect(smooth([0, 1], [0, 100], 0.9)[1]).toBeCloseTo(1, 3);
});

test('points between the steps do not smooth a curve the more', () => {
  const between = smooth([2, 4, 4, 4, 4], [1, 1.25, 1.5, 1.75, 2], 0.5);
  expect(between[4]).toBeCloseTo(smooth([2, 4], [1, 2], 0.5)[1] ?? 0);
});

test('of points at one place the last counts, as if it stood there alone', () => {
  expect(smooth([9, 2, 9, 4], [1, 1, 2, 2], 0.5)[3]).toBeCloseTo(smooth([2, 4], [1, 2], 0.5)[1] ?? 0);
});
