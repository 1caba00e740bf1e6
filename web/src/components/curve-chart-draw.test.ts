import type uPlot from 'uplot';
import { expect, test } from 'vitest';
import type { Curve } from '@/lib/curves';
import { drawCurves } from './curve-chart-draw';

const CURVE: Curve = {
  key: 'her',
  label: 'HER',
  style: { color: '#000', dash: [] },
  x: [1, 2, 3, 4],
  centre: [],
  raw: [],
  low: [],
  high: [],
  n: [],
  seeds: [],
  losses: [],
};

/** What is painted, each path in one line; a place lies where its numbers say. */
function painted(changes: Partial<Curve>, isLog: boolean): string[] {
  const paths: string[] = [];
  let path: string[] = [];
  const spot =
    (name: string) =>
    (left: number, top: number): void => {
      path.push(`${name} ${left},${top}`);
    };
  const end = (): void => {
    if (path.length > 0) paths.push(path.join(' '));
  };
  const ctx = {
    save() {},
    restore() {},
    rect() {},
    clip() {},
    setLineDash() {},
    beginPath: () => {
      path = [];
    },
    moveTo: spot('from'),
    lineTo: spot('to'),
    arc: spot('dot'),
    fill: end,
    stroke: end,
  };
  const plot = { ctx, bbox: {}, scales: { x: {}, y: { min: 0.1 } }, valToPos: (value: number) => value };
  drawCurves(plot as unknown as uPlot, [{ ...CURVE, ...changes }], null, isLog, false);
  return paths;
}

test('a line goes on over what is missing', () => {
  expect(painted({ centre: [1, null, 3, 4] }, false)).toEqual(['from 1,1 to 3,3 to 4,4']);
});

test('on a logarithmic axis a line breaks where it has no place, and a point by itself is a dot', () => {
  expect(painted({ centre: [5, 0, 3, 4] }, true)).toEqual(['from 1,5 from 3,3 to 4,4', 'dot 1,5']);
});

test('on a logarithmic axis a band that holds zero reaches down to the end of the axis', () => {
  expect(painted({ low: [1, 0, 1, 1], high: [2, 2, 2, 2] }, true)).toEqual([
    'to 1,2 to 2,2 to 3,2 to 4,2 to 4,1 to 3,1 to 2,0.1 to 1,1',
  ]);
});
