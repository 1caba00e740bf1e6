import { expect, test } from 'vitest';
import { columnsOf, countedStates, describeAxes, leadingState } from './studies';

const SPEC = {
  tasks: ['FetchPush'],
  methods: ['her', 'her-sldr'],
  seeds: [0, 1, 2],
  preset: 'quick',
  locomotion: 'zoo',
};
const VARIANTS = ['a', 'b'].map((name) => ({ name, overrides: {} }));

test('the axes are told with their lengths, variants only where there are some', () => {
  expect(describeAxes(SPEC)).toBe('1 task × 2 methods × 3 seeds');
  expect(describeAxes({ ...SPEC, variants: VARIANTS })).toBe('1 task × 2 methods × 2 variants × 3 seeds');
});

test('a column is a method in a variant', () => {
  expect(columnsOf(SPEC)).toEqual([
    { method: 'her', variant: '' },
    { method: 'her-sldr', variant: '' },
  ]);
  expect(columnsOf({ ...SPEC, methods: ['her'], variants: VARIANTS })).toEqual([
    { method: 'her', variant: 'a' },
    { method: 'her', variant: 'b' },
  ]);
});

test('states are counted in the order of a run, and those with none are left out', () => {
  expect(countedStates({ failed: 1, running: 2, queued: 0 })).toEqual([
    ['running', 2],
    ['failed', 1],
  ]);
});

test.each([
  [{ succeeded: 2, failed: 1, running: 1 }, 'running'],
  [{ succeeded: 2, queued: 1, failed: 1 }, 'queued'],
  [{ succeeded: 2, failed: 1 }, 'failed'],
  [{ succeeded: 3 }, 'succeeded'],
] as const)('of %j, %s says most', (states, state) => {
  expect(leadingState(states)).toBe(state);
});
