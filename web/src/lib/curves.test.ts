import { expect, test } from 'vitest';
import { type Curve, extentOf, hull, isFaded, nearestCurve, placesOf, rowAt } from '@/lib/curves';

const STYLE = { color: '#000000', dash: [] };

function curve(changes: Partial<Curve>): Curve {
  const empty = { x: [], centre: [], raw: [], low: [], high: [], n: [], seeds: [], losses: [] };
  return { key: 'her', label: 'her', style: STYLE, ...empty, ...changes };
}

test('the places of ragged curves are joined, each once and ascending', () => {
  const seeds = [{ runId: 'a', seed: 0, x: [1, 5], y: [0, 0], raw: [0, 0] }];
  expect(placesOf([curve({ x: [2, 4] }), curve({ x: [4, 6], seeds })])).toEqual([1, 2, 4, 5, 6]);
});

test('a value holds until the next point, and nothing is said beyond the ends', () => {
  const x = [10, 20, 30];
  expect([5, 10, 19, 20, 30, 31].map((place) => rowAt(x, place))).toEqual([-1, 0, 0, 1, 2, -1]);
  expect(rowAt([], 1)).toBe(-1);
});

test('the extent counts bands and seeds within the window only', () => {
  const seeds = [{ runId: 'a', seed: 0, x: [1, 9], y: [-1, 100], raw: [-1, 100] }];
  const drawn = [curve({ x: [1, 2], centre: [3, 4], low: [2, null], high: [7, 5], seeds })];
  expect(extentOf(drawn, [0, 5], false)).toEqual([-1, 7]);
  expect(extentOf(drawn, [0, 5], true)).toEqual([2, 7]);
  expect(extentOf(drawn, [20, 30], false)).toBeNull();
});

test('a hull holds both', () => {
  expect(hull([0, 2], [1, 5])).toEqual([0, 5]);
  expect(hull(null, [1, 5])).toEqual([1, 5]);
  expect(hull(null, null)).toBeNull();
});

test('the nearest curve is found within reach, a seed when it lies nearer', () => {
  const seeds = [{ runId: 'a', seed: 0, x: [0, 10], y: [50, 50], raw: [50, 50] }];
  const drawn = [
    curve({ key: 'her', x: [0, 10], centre: [10, 10] }),
    curve({ key: 'ddpg', x: [0, 10], centre: [40, 40], seeds }),
  ];
  const at = (height: number) => nearestCurve(drawn, 5, height, (value) => value, 20);
  expect(at(12)).toEqual({ key: 'her' });
  expect(at(38)).toEqual({ key: 'ddpg' });
  expect(at(52)).toEqual({ key: 'ddpg', runId: 'a' });
  expect(at(90)).toBeNull();
});

test('all but what stands out fade', () => {
  expect(isFaded('her', undefined, null)).toBe(false);
  expect(isFaded('her', undefined, { key: 'her' })).toBe(false);
  expect(isFaded('her', 'a', { key: 'her' })).toBe(false);
  expect(isFaded('her', 'b', { key: 'her', runId: 'a' })).toBe(true);
  expect(isFaded('ddpg', undefined, { key: 'her' })).toBe(true);
});
