import { expect, test } from 'vitest';
import { isNarrowed, readRunsSearch, searchOf, sortingOf } from './search';

test('without a word the newest come first', () => {
  expect(sortingOf({})).toEqual({ sort: 'launched', descending: true });
});

test('tasks begin with A, successes with the best', () => {
  expect(sortingOf({ sort: 'task' }).descending).toBe(false);
  expect(sortingOf({ sort: 'success' }).descending).toBe(true);
});

test.each([
  { sort: 'launched', descending: false },
  { sort: 'success', descending: true },
  { sort: 'task', descending: true },
] as const)('%j goes through the address unchanged', (sorting) => {
  expect(sortingOf(readRunsSearch({ ...searchOf(sorting) }))).toEqual(sorting);
});

test('what makes no sense is left out', () => {
  expect(readRunsSearch({ sort: 'colour', order: 'sideways', deleted: 'maybe' })).toEqual({});
});

test('sorting narrows nothing', () => {
  expect(isNarrowed({ sort: 'task', order: 'down' })).toBe(false);
  expect(isNarrowed({ task: 'FetchPush' })).toBe(true);
});
