import { expect, test } from 'vitest';
import { axisLines, numbered } from './log-axis';

test('lines stand at round numbers, wherever the axis begins', () => {
  expect(axisLines(19_000, 400_000)).toEqual([
    20_000, 30_000, 40_000, 50_000, 60_000, 70_000, 80_000, 90_000, 100_000, 200_000, 300_000, 400_000,
  ]);
  expect(axisLines(0.07, 0.3)).toEqual([0.07, 0.08, 0.09, 0.1, 0.2, 0.3]);
});

test('between two round numbers they stand evenly', () => {
  expect(axisLines(1.05, 1.95)).toEqual([1.2, 1.4, 1.6, 1.8]);
  expect(axisLines(0.31, 0.42)).toEqual([0.32, 0.34, 0.36, 0.38, 0.4, 0.42]);
  expect(axisLines(100_100, 100_900)).toEqual([100_200, 100_400, 100_600, 100_800]);
  expect(axisLines(4, 4)).toEqual([4]);
});

test('only some of them carry numbers, fewer where it is narrow', () => {
  expect(numbered([0.5, 0.9, 1, 2, 3], 200)).toEqual([0.5, null, 1, 2, null]);
  expect(numbered([0.5, 0.9, 1, 2, 3, 10], 100)).toEqual([null, null, 1, null, null, 10]);
});

test('no axis goes without numbers: all that fit, where fewer than two are powers, doubles or fives', () => {
  expect(numbered([0.3, 0.4], 1000)).toEqual([0.3, 0.4]);
  expect(numbered([3000, 4000], 1000)).toEqual([3000, 4000]);
  expect(numbered([1.2, 1.4, 1.6, 1.8], 1000)).toEqual([1.2, 1.4, 1.6, 1.8]);
  // Six, seven and eight would run into each other; a power keeps its number.
  expect(numbered([6, 7, 8, 9, 10], 300)).toEqual([6, null, null, null, 10]);
});
