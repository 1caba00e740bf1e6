import { screen, waitFor, within } from '@testing-library/react';
import type { UserEvent } from '@testing-library/user-event';
import { beforeEach, expect, test } from 'vitest';
import { piecesOf } from '@/lib/use-run-actions';
import { DONE, type FakeServer } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { RUN } from '@/testing/samples';

const RUNS = [
  { ...RUN, id: 'run-1', seed: 1 },
  { ...RUN, id: 'run-2', seed: 2, state: 'paused' as const },
  { ...RUN, id: 'run-3', seed: 3, state: 'failed' as const },
];

let server: FakeServer;
beforeEach(() => {
  server = startServer()
    .on('GET /api/runs', () => ({ body: { runs: RUNS, values: [[], [], []], next_cursor: null, total: 3 } }))
    .on('PUT /api/runs/priority', () => DONE)
    .on('POST /api/runs/actions', ({ body }) => ({
      body: {
        results: (body as { run_ids: string[] }).run_ids.map((run_id) => ({ run_id, done: true, message: 'Done.' })),
      },
    }));
});

const box = (seed: number): Promise<HTMLElement> =>
  screen.findByRole('checkbox', { name: `Select FetchPush manipulation, her-sldr, seed ${seed}` });
const bar = (): Promise<HTMLElement> => screen.findByRole('toolbar', { name: 'Selected runs' });
const sent = (): unknown[] => server.bodiesOf('POST', '/api/runs/actions');

async function press(user: UserEvent, name: RegExp): Promise<void> {
  await user.click(within(await bar()).getByRole('button', { name }));
}

test('an action goes to those of the selected runs that allow it', async () => {
  const { user } = openPage('/');
  await user.click(await screen.findByRole('checkbox', { name: 'Select all runs of this table' }));
  expect(within(await bar()).getByText('3 runs selected')).toBeTruthy();
  await press(user, /^Pause/);
  await waitFor(() => expect(sent()).toEqual([{ action: 'pause', run_ids: ['run-1'] }]));
});

test('of more runs than the server tells apart no differences are offered', async () => {
  const all = Array.from({ length: 51 }, (_, seed) => ({ ...RUN, id: `run-${seed}`, seed }));
  server.on('GET /api/runs', ({ url }) => {
    const runs = url.searchParams.get('limit') === '51' ? all : RUNS;
    return { body: { runs, values: runs.map(() => []), next_cursor: null, total: all.length } };
  });
  const { user } = openPage('/');
  await user.click(await screen.findByRole('checkbox', { name: 'Select all runs of this table' }));
  expect(within(await bar()).getByRole('link', { name: 'Compare' })).toBeTruthy();
  expect(within(await bar()).queryByRole('link', { name: 'Differences' })).toBeNull();
  expect(within(await bar()).getByRole<HTMLButtonElement>('button', { name: 'Differences' }).disabled).toBe(true);
});

test('cancelling several asks once', async () => {
  const { user } = openPage('/');
  await user.click(await box(1));
  await user.click(await box(2));
  await press(user, /^Cancel/);
  await user.click(await screen.findByRole('button', { name: 'Yes, cancel them' }));
  await waitFor(() => expect(sent()).toEqual([{ action: 'cancel', run_ids: ['run-1', 'run-2'] }]));
});

test('the keyboard selects: space, then Shift with the arrows, and Escape clears', async () => {
  const { user } = openPage('/');
  (await box(1)).focus();
  await user.keyboard(' ');
  await user.keyboard('{Shift>}{ArrowDown}{ArrowDown}{/Shift}');
  expect(within(await bar()).getByText('3 runs selected')).toBeTruthy();
  expect(document.activeElement).toBe(await box(3));
  await user.keyboard('{Escape}');
  expect(screen.queryByRole('toolbar')).toBeNull();
});

test('deleting several can be undone', async () => {
  const { user } = openPage('/');
  await user.click(await box(2));
  await user.click(await box(3));
  await press(user, /^Delete/);
  expect(await screen.findByText('2 runs deleted.')).toBeTruthy();
  await user.click(await screen.findByRole('button', { name: 'Undo' }));
  await waitFor(() =>
    expect(sent()).toEqual([
      { action: 'delete', run_ids: ['run-2', 'run-3'] },
      { action: 'restore', run_ids: ['run-2', 'run-3'] },
    ]),
  );
});

test('what was not done says why', async () => {
  server.on('POST /api/runs/actions', () => ({
    body: { results: [{ run_id: 'run-3', done: false, message: 'Run run-3 is needed by run run-4.' }] },
  }));
  const { user } = openPage('/');
  await user.click(await box(3));
  await press(user, /^Delete/);
  expect((await screen.findByRole('alert')).textContent).toContain('Run run-3 is needed by run run-4.');
  expect(screen.queryByRole('button', { name: 'Undo' })).toBeNull();
});

test('a priority goes to the selected runs that have not ended', async () => {
  const { user } = openPage('/');
  await user.click(await screen.findByRole('checkbox', { name: 'Select all runs of this table' }));
  await press(user, /^Priority/);
  const field = await screen.findByRole('textbox', { name: 'Priority of the selected runs' });
  await user.clear(field);
  await user.type(field, '7{Enter}');
  await waitFor(() =>
    expect(server.bodiesOf('PUT', '/api/runs/priority')).toEqual([{ run_ids: ['run-1', 'run-2'], priority: 7 }]),
  );
});

test('runs of different priorities can all be given that of the first', async () => {
  const runs = [
    { ...RUN, id: 'run-1', seed: 1, priority: 5 },
    { ...RUN, id: 'run-2', seed: 2 },
  ];
  server.on('GET /api/runs', () => ({ body: { runs, values: [[], []], next_cursor: null, total: 2 } }));
  const { user } = openPage('/');
  await user.click(await screen.findByRole('checkbox', { name: 'Select all runs of this table' }));
  await press(user, /^Priority/);
  const field = await screen.findByRole<HTMLInputElement>('textbox', { name: 'Priority of the selected runs' });
  expect(field.value).toBe('');
  await user.type(field, '5{Enter}');
  await waitFor(() =>
    expect(server.bodiesOf('PUT', '/api/runs/priority')).toEqual([{ run_ids: ['run-1', 'run-2'], priority: 5 }]),
  );
});

test('cancelling runs out of view asks, as they may train by now', async () => {
  const runs = RUNS.map((run) => ({ ...run, state: 'queued' as const }));
  const group = { keys: { method: 'her-sldr' }, runs: 3, seeds: [1, 2, 3], states: { queued: 3 }, spread: null };
  server
    .on('GET /api/run-groups', () => ({ body: { groups: [group], total: 3 } }))
    .on('GET /api/runs', () => ({ body: { runs, values: [[], [], []], next_cursor: null, total: 3 } }));
  const { user } = openPage('/?group=method');
  await user.click(await screen.findByRole('checkbox', { name: /her-sldr/ }));
  await press(user, /^Cancel/);
  await user.click(await screen.findByRole('button', { name: 'Yes, cancel them' }));
  await waitFor(() => expect(sent()).toEqual([{ action: 'cancel', run_ids: ['run-1', 'run-2', 'run-3'] }]));
});

test('as many runs are named at a time as a request may name', () => {
  const ids = Array.from({ length: 2500 }, (_, index) => `run-${index}`);
  expect(piecesOf(ids).map((piece) => piece.length)).toEqual([1000, 1000, 500]);
  expect(piecesOf(ids).flat()).toEqual(ids);
  expect(piecesOf([])).toEqual([]);
});
