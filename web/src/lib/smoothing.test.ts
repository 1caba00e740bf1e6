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
