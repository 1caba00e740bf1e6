import { expect, test } from 'vitest';
import { joined, partsOf, readCompareSearch, toggled } from './search';

/** What is left of an address. */
function read(raw: Record<string, unknown>): Record<string, unknown> {
  return Object.fromEntries(Object.entries(readCompareSearch(raw)).filter(([, value]) => value !== undefined));
}

test('a whole view is read from its address', () => {
  const view = {
    tab: 'best',
    study: 'abc',
    metric: 'stream/sldr/object/mean',
    x: 'env_steps',
    statistic: 'iqm',
    logx: 'yes',
    seeds: 'yes',
    drop: 'yes',
    hover: 'run',
    pin: 'her-sldr',
    tables: 'FetchPush,FetchSlide',
  };
  expect(read(view)).toEqual(view);
  expect(read({ level: '0.9', smooth: '0.6', from: '5', to: '20' })).toEqual({
    level: 0.9,
    smooth: 0.6,
    from: 5,
    to: 20,
  });
});

test('what makes no sense is left out', () => {
  expect(read({ tab: 'x', x: 'time', statistic: 'max', level: '2', smooth: '1', logx: 'no', phase: 'both' })).toEqual(
    {},
  );
  expect(read({ from: '9', to: '2', study: '', pin: null })).toEqual({});
});

test('several names are one value', () => {
  expect(partsOf('a,b')).toEqual(['a', 'b']);
  expect(partsOf(undefined)).toEqual([]);
  expect(joined([])).toBeUndefined();
  expect(toggled('a,b', 'a')).toBe('b');
  expect(toggled(undefined, 'a')).toBe('a');
  expect(toggled('a', 'a')).toBeUndefined();
});
