import { expect, test } from 'vitest';
import { COMPARISON } from '@/testing/comparison';
import { byFamily } from './families';
import { panelCurves, panelWords, sourcesOf, wholeOf, yExtent } from './panels';

const [PANEL] = COMPARISON.panels;
if (PANEL === undefined) throw new Error('The sample has no panel.');

test('a group with a band has a centre, one with too few seeds has its seeds', () => {
  const [few, band] = panelCurves(PANEL, COMPARISON.groups, 0, 'light');
  expect(few?.centre).toEqual([]);
  expect(few?.seeds.map(({ seed, y }) => [seed, y])).toEqual([[7, [0.1, 0.2, 0.3]]]);
  expect(band?.centre).toEqual([0.2, 0.5, 0.9]);
  expect(band?.losses).toEqual([{ x: 2, y: 0.5, n: 2 }]);
  expect(band?.style).not.toEqual(few?.style);
});

test('smoothing keeps the computed line, and means the same on every axis', () => {
  const stretched = {
    ...PANEL,
    curves: PANEL.curves.map((curve) => ({ ...curve, x: curve.x.map((place) => 19_000 * place) })),
  };
  const centreOf = (panel: typeof PANEL) => panelCurves(panel, COMPARISON.groups, 0.5, 'light')[1];
  const smoothed = centreOf(PANEL);
  expect(smoothed?.raw).toEqual([0.2, 0.5, 0.9]);
  // Weights 1, 1/2, 1/4 into the past, over their sum.
  expect(smoothed?.centre[1]).toBeCloseTo((0.5 + 0.2 / 2) / 1.5);
  expect(smoothed?.centre[2]).toBeCloseTo((0.9 + 0.5 / 2 + 0.2 / 4) / 1.75);
  expect(centreOf(stretched)?.centre).toEqual(smoothed?.centre);
});

test('a panel tells what most curves are, then names the others', () => {
  const few = '1 seed, each by itself: too few for a band';
  const band = 'HER-Sparse+SLDR: median of 2 to 4 seeds, band: quartiles (25 to 75 %)';
  const [her, ...others] = PANEL.curves;
  const nothingElse = { others: [], otherCurves: 0 };
  expect(panelWords({ ...PANEL, curves: [] }, COMPARISON.groups)).toEqual({ first: '', ...nothingElse });
  expect(panelWords({ ...PANEL, curves: her === undefined ? [] : [her] }, COMPARISON.groups)).toEqual({
    first: few,
    ...nothingElse,
  });

  const more = { ...PANEL, curves: her === undefined ? [] : [her, { ...her, group: 'cher' }, ...others] };
  expect(panelWords(more, COMPARISON.groups)).toEqual({ first: `${few}; ${band}`, ...nothingElse });
});

test('what takes more than two lines is kept apart, and none of it is lost', () => {
  const few = 'HER-Sparse: 1 seed, each by itself: too few for a band';
  const band = 'HER-Sparse+SLDR: median of 2 to 4 seeds, band: quartiles (25 to 75 %)';
  expect(panelWords(PANEL, COMPARISON.groups)).toEqual({ first: few, others: [band], otherCurves: 1 });
});

test('the x axis begins at nothing, or at the first point where it is logarithmic', () => {
  expect(wholeOf(COMPARISON.panels, false)).toEqual([0, 3]);
  expect(wholeOf(COMPARISON.panels, true)).toEqual([1, 3]);
  expect(wholeOf([], false)).toEqual([0, 1]);
});

test('shares have an axis of their own; others hold what is drawn', () => {
  const curves = panelCurves(PANEL, COMPARISON.groups, 0, 'light');
  expect(yExtent(curves, [0, 3], true, false)).toEqual([-0.02, 1.02]);
  expect(yExtent(curves, [0, 3], false, false)?.[0]).toBe(0);
  expect(yExtent(curves, [9, 10], false, false)).toBeNull();
});

test('tasks stand as in the paper, unknown ones at the end', () => {
  const tasks = ['Mine', 'HandPenFull', 'FetchSlide', 'FetchPush'].map((task) => ({ task }));
  expect(byFamily(tasks).map(({ things }) => things.map(({ task }) => task))).toEqual([
    ['FetchPush', 'FetchSlide'],
    ['HandPenFull'],
    ['Mine'],
  ]);
});

test('a panel is made of other runs when some are filtered away, of the same when they go on', () => {
  const [, ...rest] = PANEL.curves;
  expect(sourcesOf({ ...PANEL, curves: rest })).not.toBe(sourcesOf(PANEL));
  const longer = PANEL.curves.map((curve) => ({ ...curve, x: [...curve.x, 4], centre: [...curve.centre, 1] }));
  expect(sourcesOf({ ...PANEL, curves: longer.reverse() })).toBe(sourcesOf(PANEL));
});

test('a panel with its seeds drawn, or without runs that have ended, is made of something else', () => {
  const changed = (changes: object, memberChanges: object = {}) =>
    PANEL.curves.map((curve) => ({
      ...curve,
      ...changes,
      members: curve.members.map((member) => ({ ...member, ...memberChanges })),
    }));
  expect(sourcesOf({ ...PANEL, curves: changed({}, { x: [1], y: [1] }) })).not.toBe(sourcesOf(PANEL));
  expect(sourcesOf({ ...PANEL, curves: changed({ holds: true }) })).not.toBe(sourcesOf(PANEL));
});
