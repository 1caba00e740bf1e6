import { expect, test } from 'vitest';
import { readSettingGroups } from '@/lib/settings';
import { CONFIG_SCHEMA } from '@/testing/samples';
import { readRows, readVariants, rowsOf } from './setting-rows';

const GROUPS = readSettingGroups(CONFIG_SCHEMA);
const SPEC = { tasks: ['FetchPush'], methods: ['her'], seeds: [0], preset: 'quick', locomotion: 'zoo' };

test('one value is set in every run, several are compared', () => {
  const rows = [
    { path: 'loop.epochs', text: '5' },
    { path: 'agent.gamma', text: '0.95, 0.98' },
  ];
  expect(readRows(GROUPS, rows)).toEqual({
    overrides: { loop: { epochs: 5 } },
    variants: [
      { name: 'gamma=0.95', overrides: { agent: { gamma: 0.95 } } },
      { name: 'gamma=0.98', overrides: { agent: { gamma: 0.98 } } },
    ],
    problems: {},
  });
});

test('lists are set apart by strokes', () => {
  const { overrides, variants } = readRows(GROUPS, [{ path: 'agent.hidden_sizes', text: '64, 64 | 128, 128' }]);
  expect(overrides).toEqual({});
  expect(variants.map(({ overrides: settings }) => settings)).toEqual([
    { agent: { hidden_sizes: [64, 64] } },
    { agent: { hidden_sizes: [128, 128] } },
  ]);
});

test.each([
  ['-1', 'It must be above 0.'],
  ['5, 5', 'A value is written twice.'],
  ['5, ', 'Enter a whole number.'],
])('%s is refused in a sentence', (text, sentence) => {
  expect(readRows(GROUPS, [{ path: 'loop.epochs', text }]).problems).toEqual({ 0: sentence });
});

test('a second axis, or a setting named twice, is refused at its row', () => {
  const rows = [
    { path: 'loop.epochs', text: '5, 6' },
    { path: 'agent.gamma', text: '0.9, 0.95' },
    { path: 'loop.epochs', text: '7' },
  ];
  expect(Object.keys(readRows(GROUPS, rows).problems)).toEqual(['1', '2']);
});

test('a spec becomes the rows that say the same', () => {
  const rows = [
    { path: 'loop.epochs', text: '5' },
    { path: 'agent.gamma', text: '0.95, 0.98' },
  ];
  const { overrides, variants } = readRows(GROUPS, rows);
  expect(rowsOf({ ...SPEC, overrides, variants })).toEqual({ rows, variants: [] });
});

test('variants that no row can say are kept as they are', () => {
  const variants = [{ name: 'both', overrides: { agent: { gamma: 0.9 }, loop: { epochs: 2 } } }];
  expect(rowsOf({ ...SPEC, variants })).toEqual({ rows: [], variants });
});

test('a row is read as variants, however many values it has', () => {
  const read = (text: string) => readVariants(GROUPS, { path: 'agent.gamma', text });
  expect(read('0.98')).toEqual({ variants: [{ name: 'gamma=0.98', overrides: { agent: { gamma: 0.98 } } }] });
  expect(read('0.9, 0.98').variants.map(({ name }) => name)).toEqual(['gamma=0.9', 'gamma=0.98']);
  expect(read(' ')).toEqual({ variants: [] });
  expect(read('0.9, 0.9')).toEqual({ variants: [], problem: 'A value is written twice.' });
});
