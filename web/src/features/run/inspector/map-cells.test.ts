import { expect, test } from 'vitest';
import type { CoverageAnswer } from './answers';
import { ALL_LAYERS, mapCells, onLayer } from './map-cells';

const AXIS = { name: '', unit: '', edges: [0, 1], names: [] };
const COVERED: CoverageAnswer = {
  space: 'goal',
  title: '',
  x: AXIS,
  y: AXIS,
  layer: AXIS,
  episodes: [[[4, 0]], [[2, 0]]],
  successes: [[[3, 0]], [[1, 0]]],
  median_s: [[[0.4, null]], [[0.8, null]]],
};

test('a layer is what was counted on it', () => {
  expect(mapCells(onLayer(COVERED, 0), 'success')).toEqual([[0.75, null]]);
  expect(mapCells(onLayer(COVERED, 1), 'time')).toEqual([[0.8, null]]);
});

test('all layers together count all demonstrations', () => {
  const all = onLayer(COVERED, ALL_LAYERS);
  expect(all.episodes).toEqual([[6, 0]]);
  expect(mapCells(all, 'success')).toEqual([[4 / 6, null]]);
  expect(mapCells(all, 'time')[0]?.[0]).toBeCloseTo((3 * 0.4 + 0.8) / 4);
});
