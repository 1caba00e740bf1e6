import { expect, test } from 'vitest';
import { numbered, roundNumbers } from './log-axis';

test('lines stand at round numbers, wherever the axis begins', () => {
  expect(roundNumbers(19_000, 400_000)).toEqual([
    20_000, 30_000, 40_000, 50_000, 60_000, 70_000, 80_000, 90_000, 100_000, 200_000, 300_000, 400_000,
  ]);
  expect(roundNumbers(0.07, 0.3)).toEqual([0.07, 0.08, 0.09, 0.1, 0.2, 0.3]);
});

test('only some of them carry numbers, fewer where it is narrow', () => {
  expect(numbered([0.5, 0.9, 1, 2, 3], true)).toEqual([0.5, null, 1, 2, null]);
  expect(numbered([0.5, 0.9, 1, 2, 3, 10], false)).toEqual([null, null, 1, null, null, 10]);
});
