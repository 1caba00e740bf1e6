import { expect, test } from 'vitest';
import { moved, scaled, showing } from '@/lib/zoom';

const WHOLE = [0, 100] as const;

test('zooming in keeps the place where it is', () => {
  expect(scaled([0, 100], WHOLE, 25, 0.5)).toEqual([12.5, 62.5]);
});

test('zooming out beyond the whole shows the whole', () => {
  expect(scaled([30, 90], WHOLE, 60, 2)).toBeNull();
});

test('zooming out at an end stays inside', () => {
  expect(scaled([80, 100], WHOLE, 90, 2)).toEqual([60, 100]);
});

test('a window never shrinks to nothing', () => {
  const [start, end] = scaled([50, 50.1], WHOLE, 50, 0.001) ?? [0, 0];
  expect(end - start).toBeCloseTo(0.1);
});

test('moving stops at the ends', () => {
  expect(moved([40, 60], WHOLE, 0.5)).toEqual([50, 70]);
  expect(moved([90, 100], WHOLE, 0.5)).toEqual([90, 100]);
});

test('a place outside is brought to the edge, one inside moves nothing', () => {
  expect(showing([40, 60], WHOLE, 70)).toEqual([50, 70]);
  expect(showing([40, 60], WHOLE, 30)).toEqual([30, 50]);
  expect(showing([40, 60], WHOLE, 50)).toEqual([40, 60]);
});
