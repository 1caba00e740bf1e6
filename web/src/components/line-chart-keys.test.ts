import { expect, test } from 'vitest';
import { readChartKey } from './line-chart-keys';

const PLACE = { x: [0, 10, 20, 30], at: 1, range: [0, 30], whole: [0, 30] } as const;

test('arrows step from point to point and stop at the ends', () => {
  expect(readChartKey('ArrowRight', false, PLACE)?.at).toBe(2);
  expect(readChartKey('ArrowLeft', false, PLACE)?.at).toBe(0);
  expect(readChartKey('ArrowRight', false, { ...PLACE, at: 3 })?.at).toBe(3);
});

test('the first arrow lands on the newest point', () => {
  expect(readChartKey('ArrowLeft', false, { ...PLACE, at: null })?.at).toBe(3);
});

test('plus zooms about the cursor, minus back out, 0 shows all', () => {
  expect(readChartKey('+', false, PLACE)?.range).toEqual([5, 20]);
  expect(readChartKey('-', false, { ...PLACE, range: [5, 20] })?.range).toBeNull();
  expect(readChartKey('0', false, { ...PLACE, range: [5, 20] })).toEqual({ range: null });
});

test('with Shift the arrows move the window', () => {
  expect(readChartKey('ArrowRight', true, { ...PLACE, range: [0, 20] })?.range).toEqual([5, 25]);
});

test('stepping out of the window takes the window along', () => {
  expect(readChartKey('ArrowRight', false, { ...PLACE, range: [0, 15] })).toEqual({ at: 2, range: [5, 20] });
});

test('other keys, and charts without points, are left alone', () => {
  expect(readChartKey('a', false, PLACE)).toBeUndefined();
  expect(readChartKey('+', false, { ...PLACE, x: [] })).toBeUndefined();
});
