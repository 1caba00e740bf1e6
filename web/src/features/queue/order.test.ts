import { expect, test } from 'vitest';
import type { QueueEntry } from '@/client/schema.gen';
import { RUN } from '@/testing/samples';
import { dropped, endOf, reordered, stepped } from './order';

function entry(id: string, state: QueueEntry['run']['state'], ends_at: string | null = null): QueueEntry {
  return { run: { ...RUN, id, state }, position: null, waits_for: '', starts_at: null, ends_at };
}

const QUEUE = [
  entry('running', 'running'),
  entry('a', 'queued'),
  entry('b', 'queued'),
  entry('blocked', 'blocked'),
  entry('c', 'queued'),
  entry('paused', 'paused'),
];

const WHOLE = { entries: QUEUE, isWhole: true };
const CUT = { entries: QUEUE, isWhole: false };

test.each([
  ['b', -1, { runId: 'b', before: 'a' }],
  ['a', 1, { runId: 'a', before: 'c' }],
  ['b', 1, { runId: 'b', before: null }],
  ['a', -1, undefined],
  ['c', 1, undefined],
  ['running', 1, undefined],
  ['blocked', 1, undefined],
] as const)('a step of %s by %d is %j', (id, step, move) => {
  expect(stepped(WHOLE, id, step)).toEqual(move);
});

test.each([
  ['c', 'a', false, { runId: 'c', before: 'a' }],
  ['a', 'b', true, { runId: 'a', before: 'c' }],
  ['a', 'c', true, { runId: 'a', before: null }],
  ['a', 'b', false, undefined],
  ['b', 'a', true, undefined],
  ['a', 'running', true, undefined],
  ['a', 'blocked', true, undefined],
] as const)('%s dropped on %s, lower half %s, is %j', (id, on, isLower, move) => {
  expect(dropped(WHOLE, id, on, isLower)).toEqual(move);
});

test('behind the last row of a list that is cut nothing can be put', () => {
  expect(stepped(CUT, 'b', 1)).toBeUndefined();
  expect(dropped(CUT, 'a', 'c', true)).toBeUndefined();
  expect(stepped(CUT, 'a', 1)).toEqual({ runId: 'a', before: 'c' });
  expect(dropped(CUT, 'c', 'a', false)).toEqual({ runId: 'c', before: 'a' });
});

test('the order is shown as it will be', () => {
  const ids = (entries: readonly QueueEntry[]) => entries.map(({ run }) => run.id);
  expect(ids(reordered(QUEUE, { runId: 'c', before: 'a' }))).toEqual(['running', 'c', 'a', 'b', 'blocked', 'paused']);
  expect(ids(reordered(QUEUE, { runId: 'a', before: null }))).toEqual(['running', 'b', 'blocked', 'c', 'a', 'paused']);
  expect(reordered(QUEUE, { runId: 'a', before: 'gone' })).toEqual(QUEUE);
});

test('the end is that of the last run, unless one is unknown; paused ones do not count', () => {
  const early = entry('a', 'queued', '2026-01-01T10:00:00Z');
  const late = entry('b', 'queued', '2026-01-01T11:00:00Z');
  expect(endOf([late, early, entry('c', 'paused')])).toBe(Date.parse('2026-01-01T11:00:00Z'));
  expect(endOf([early, entry('c', 'blocked')])).toBeNull();
});
