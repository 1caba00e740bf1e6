import { expect, test } from 'vitest';
import { shownColumns, withColumn } from './columns';
import { csvAddress } from './components/csv-link';
import { filtersOf } from './components/filter-chips';
import { formatSeeds } from './group-words';
import { formatMetric, parseMetricColumn, writeMetricColumn } from './metric-columns';
import { filterQuery, isNarrowed, type RunsSearch, readRunsSearch } from './search';
import { groupSortingOf, runSortingOf, searchOf, sortingOf, turned } from './sorting';

test('without a word the newest come first', () => {
  expect(sortingOf({})).toEqual({ sort: 'launched', descending: true });
});

test('tasks begin with A, successes with the best', () => {
  expect(sortingOf({ sort: 'task' }).descending).toBe(false);
  expect(sortingOf({ sort: 'success' }).descending).toBe(true);
  expect(turned({ sort: 'success', descending: true }, 'success').descending).toBe(false);
  expect(turned({ sort: 'success', descending: true }, 'a/b:last').descending).toBe(true);
});

test.each([
  { sort: 'launched', descending: false },
  { sort: 'success', descending: true },
  { sort: 'task', descending: true },
  { sort: 'critic/task/loss:mean5', descending: false },
])('%j goes through the address unchanged', (sorting) => {
  expect(sortingOf(readRunsSearch({ ...searchOf(sorting) }))).toEqual(sorting);
});

test('what only groups or only runs can be sorted by counts for no other', () => {
  expect(runSortingOf({ sort: 'median' }).sort).toBe('launched');
  expect(runSortingOf({ sort: 'tags' }).sort).toBe('launched');
  expect(groupSortingOf({ sort: 'median' })).toEqual({ sort: 'median', descending: true });
  expect(groupSortingOf({ sort: 'speed' }).sort).toBe('launched');
});

test('what makes no sense is left out', () => {
  const raw = { order: 'sideways', deleted: 'maybe', state: 'lost', columns: 'loss', seed_from: '-1', success_to: '7' };
  expect(readRunsSearch(raw)).toEqual({});
});

test('the whole page goes through the address unchanged', () => {
  const search: RunsSearch = {
    state: ['queued', 'running'],
    task: ['FetchPush'],
    tag: ['good', 'to check'],
    no_tag: ['broken'],
    seed_from: 0,
    seed_to: 4,
    success_from: 0.5,
    columns: ['test/success_rate:best', 'critic/task/loss:mean10'],
    show: ['state', 'task', 'preset'],
    group: ['task', 'method'],
    open: ['FetchPush|her'],
  };
  const written = Object.fromEntries(Object.entries(search).map(([key, value]) => [key, String(value)]));
  expect(readRunsSearch(written)).toEqual(search);
});

test('sorting, columns and groups narrow nothing', () => {
  expect(isNarrowed({ sort: 'task', order: 'down', columns: ['a/b:last'], group: ['task'] })).toBe(false);
  expect(isNarrowed({ task: ['FetchPush'] })).toBe(true);
  expect(filterQuery({ deleted: 'yes' }).deleted).toBe(true);
});

test('columns of metrics are read as they are written', () => {
  expect(parseMetricColumn('a/b:mean5')).toEqual({ name: 'a/b', statistic: 'mean', window: 5 });
  expect(['a/b', 'a/b:mean', 'a/b:mean0', 'a/b:mean21', ':last'].map(parseMetricColumn)).toEqual(Array(5).fill(null));
  expect(writeMetricColumn({ name: 'a/b', statistic: 'best', window: 1 })).toBe('a/b:best');
  expect(formatMetric('test/success_rate', 0.9125)).toBe('91.3\u202f%');
});

test('a column more or less is written only where it differs from the usual ones', () => {
  expect(withColumn('speed', false)).not.toContain('speed');
  expect(withColumn('speed', true, withColumn('speed', false))).toBeUndefined();
  expect(shownColumns([])).toEqual(['task']);
});

test('filters are told in words', () => {
  const search: RunsSearch = {
    state: ['queued', 'paused'],
    no_tag: ['bad'],
    seed_from: 2,
    seed_to: 4,
    success_from: 0.9,
  };
  expect(filtersOf(search).map(({ text }) => text)).toEqual([
    'state queued, paused',
    'not tagged bad',
    'seed 2 to 4',
    'success from 90\u202f%',
  ]);
});

test('seeds that follow each other stand together', () => {
  expect(formatSeeds([0, 1, 2, 5, 7, 8])).toBe('0–2, 5, 7–8');
});

test('the CSV file holds what the page shows', () => {
  const runs = csvAddress({ task: ['FetchPush'], sort: 'seed', columns: ['a/b:last'], show: ['task'] });
  expect(runs).toBe('/api/runs.csv?task=FetchPush&deleted=false&sort=seed&descending=false&column=a%2Fb%3Alast');
  const groups = new URL(csvAddress({ group: ['task', 'method'], sort: 'median' }), 'http://here');
  expect(groups.pathname).toBe('/api/run-groups.csv');
  expect(groups.searchParams.getAll('by')).toEqual(['task', 'method']);
});
