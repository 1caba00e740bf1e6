import { expect, test } from 'vitest';
import { axisOfPoints, cellName, inkOn, type Rgb, rangeOf, scaleColour, shareOf } from './heat-map';

const SCALE: readonly Rgb[] = [
  [0, 0, 0],
  [100, 50, 0],
  [200, 200, 200],
];

test('colours lie between those of the scale, and stay within it', () => {
  expect(scaleColour(SCALE, 0.25)).toEqual([50, 25, 0]);
  expect(scaleColour(SCALE, 0.5)).toEqual([100, 50, 0]);
  expect(scaleColour(SCALE, 7)).toEqual([200, 200, 200]);
  expect(scaleColour(SCALE, -1)).toEqual([0, 0, 0]);
});

test('ink is dark on bright colours and white on dark ones', () => {
  expect(inkOn([253, 231, 37])).toBe('#111');
  expect(inkOn([68, 1, 84])).toBe('#fff');
});

test('cells without a value do not count for the range', () => {
  expect(
    rangeOf([
      [null, 2],
      [-1, null],
    ]),
  ).toEqual([-1, 2]);
  expect(rangeOf([[null]])).toBeUndefined();
});

test('all values of a range without width are low', () => {
  expect(shareOf(3, [3, 3])).toBe(0);
  expect(shareOf(3, [2, 6])).toBe(0.25);
});

test('a cell is called by its name, or by the numbers it lies between', () => {
  expect(cellName({ name: 'x', unit: 'cm', edges: [0, 1.25, 2.5], names: [] }, 1)).toBe('1.25 to 2.5\u202fcm');
  expect(cellName({ name: 'axis', unit: '', edges: [0, 1], names: ['+x'] }, 0)).toBe('+x');
});

test('points lie in the middle of their cells', () => {
  expect(axisOfPoints('x', 'm', [1, 2, 3]).edges).toEqual([0.5, 1.5, 2.5, 3.5]);
});
