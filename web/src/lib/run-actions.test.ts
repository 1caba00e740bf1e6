import { expect, test } from 'vitest';
import { ACTION_MEANING, ACTIONS, type Actable, allows, summarise } from '@/lib/run-actions';

const RUN: Actable = {
  id: 'a',
  phase: 'manipulation',
  state: 'running',
  cancel_requested: false,
  pause_requested: false,
  is_below_gate: false,
  deleted_at: null,
};

const allowed = (changes: Partial<Actable>) => ACTIONS.filter((action) => allows({ ...RUN, ...changes }, action));

test.each([
  [{ state: 'running' }, ['pause', 'cancel']],
  [{ state: 'running', pause_requested: true }, ['resume', 'cancel']],
  [{ state: 'running', cancel_requested: true }, []],
  [{ state: 'queued' }, ['pause', 'cancel', 'delete']],
  [{ state: 'blocked', is_below_gate: true }, ['release', 'pause', 'cancel', 'delete']],
  [{ state: 'paused' }, ['resume', 'cancel', 'delete']],
  [{ state: 'failed' }, ['retry', 'delete']],
  [{ state: 'succeeded' }, ['delete']],
  [{ state: 'cancelled', deleted_at: '2026-01-01T10:00:00Z' }, ['restore']],
] as const)('a run that is %j allows %j', (changes, actions) => {
  expect(allowed(changes)).toEqual(actions);
});

test('to cancel is told with what it loses, beside pausing, which loses nothing', () => {
  expect(ACTION_MEANING.cancel).toMatch(/learnt since the last checkpoint is lost/);
});

test('of one run the sentence of the server is told', () => {
  const { text, isProblem } = summarise('pause', [{ run_id: 'a', done: false, message: 'It has ended.' }]);
  expect([text, isProblem]).toEqual(['It has ended.', true]);
});

test('of several runs they are counted, and the refused ones say why', () => {
  const results = [
    { run_id: 'a', done: true, message: 'Run a is deleted.' },
    { run_id: 'b', done: false, message: 'Run b is running.' },
  ];
  expect(summarise('delete', results)).toEqual({
    text: '1 of 2 runs deleted.',
    details: ['Run b is running.'],
    isProblem: true,
    doneIds: ['a'],
  });
});

test('many refusals are cut', () => {
  const results = Array.from({ length: 6 }, (_, at) => ({ run_id: `${at}`, done: false, message: `No ${at}.` }));
  expect(summarise('retry', results).details).toEqual(['No 0.', 'No 1.', 'No 2.', 'and 3 more']);
});
