import { screen, waitFor, within } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import type { QueueEntry, RunState } from '@/client/schema.gen';
import { DONE, type FakeServer, problem } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { RUN } from '@/testing/samples';

/** Nearly four minutes ahead: however slow the test is, three and some seconds are left. */
const SOON = new Date(Date.now() + 3 * 60_000 + 59_000).toISOString();

function entry(seed: number, state: RunState, position: number | null, waits_for: string): QueueEntry {
  const run = { ...RUN, id: `run-${seed}`, seed, state, needs: ['run-9'] };
  return { run, position, waits_for, starts_at: state === 'queued' ? SOON : null, ends_at: null };
}

let server: FakeServer;
beforeEach(() => {
  const entries = [
    entry(1, 'running', null, 'A worker trains it.'),
    entry(2, 'queued', 1, 'Waits for a free slot.'),
    entry(3, 'queued', 2, 'It waits for a free slot, behind 1 other run.'),
    entry(4, 'blocked', null, 'Waits for the locomotion run run-9.'),
  ];
  server = startServer()
    .on('GET /api/queue', () => ({ body: { entries, total: entries.length } }))
    .on('POST /api/runs/run-2/move', () => DONE)
    .on('PUT /api/runs/priority', () => DONE);
});

const order = (): string[] =>
  within(screen.getByRole('list', { name: 'Queue' }))
    .getAllByRole('listitem')
    .map((item) => item.dataset.run ?? '');

test('each run says what it waits for and when it starts', async () => {
  openPage('/queue');
  expect(await screen.findByText('Waits for a free slot.')).toBeTruthy();
  expect(screen.getAllByText(/^in 3m/)).toHaveLength(2);
  expect(screen.getByText('1 running · 3 waiting')).toBeTruthy();
  expect(screen.getByRole('link', { name: 'run-9' }).getAttribute('href')).toBe('/runs/run-9');
});

test('Alt with the down key moves a run, and it keeps the focus', async () => {
  const { user } = openPage('/queue');
  (await screen.findByRole('link', { name: 'FetchPush manipulation, her-sldr, seed 2' })).focus();
  await user.keyboard('{Alt>}{ArrowDown}{/Alt}');
  await waitFor(() => expect(server.bodiesOf('POST', '/api/runs/run-2/move')).toEqual([{ before: null }]));
  expect(screen.getByRole('link', { name: 'FetchPush manipulation, her-sldr, seed 2' })).toBe(document.activeElement);
  expect(screen.getByText('FetchPush manipulation, her-sldr, seed 2 is now the last.')).toBeTruthy();
});

test('the new order stands before the server has answered', async () => {
  server.on('POST /api/runs/run-2/move', () => new Promise(() => {}));
  const { user } = openPage('/queue');
  await user.click(await screen.findByRole('button', { name: /seed 2 down$/ }));
  await waitFor(() => expect(order()).toEqual(['run-1', 'run-3', 'run-2', 'run-4']));
});

test('a move that the server never hears of is taken back, and that is told', async () => {
  const { user } = openPage('/queue');
  const button = await screen.findByRole('button', { name: /seed 2 down$/ });
  server.isDown = true;
  await user.click(button);
  expect(await screen.findByText('The order is as it was.')).toBeTruthy();
  expect(order()).toEqual(['run-1', 'run-2', 'run-3', 'run-4']);
});

test('what runs or is blocked has no place to change', async () => {
  openPage('/queue');
  await screen.findByText('A worker trains it.');
  expect(screen.queryByRole('button', { name: /seed [14] (up|down)$/ })).toBeNull();
});

test('the last row shown does not move down where more rows follow', async () => {
  const entries = [entry(1, 'queued', 1, 'Waits.'), entry(2, 'queued', 2, 'Waits.')];
  server.on('GET /api/queue', () => ({ body: { entries, total: 3 } }));
  openPage('/queue');
  const isStill = (name: RegExp) => screen.getByRole('button', { name }).getAttribute('aria-disabled');
  await screen.findAllByText('Waits.');
  expect(isStill(/seed 1 down$/)).toBe('true');
  expect(isStill(/seed 2 up$/)).toBe('false');
});

test('a typed priority is sent on Enter', async () => {
  const { user } = openPage('/queue');
  const field = await screen.findByRole('textbox', { name: /^Priority of .* seed 2$/ });
  await user.clear(field);
  await user.type(field, '5{Enter}');
  await waitFor(() =>
    expect(server.bodiesOf('PUT', '/api/runs/priority')).toEqual([{ run_ids: ['run-2'], priority: 5 }]),
  );
});

test('a priority that is typed behind the one that is there is sent as well', async () => {
  const { user } = openPage('/queue');
  const field = await screen.findByRole<HTMLInputElement>('textbox', { name: /^Priority of .* seed 2$/ });
  await user.type(field, '5');
  expect(field.value).toBe('05');
  await user.tab();
  await waitFor(() =>
    expect(server.bodiesOf('PUT', '/api/runs/priority')).toEqual([{ run_ids: ['run-2'], priority: 5 }]),
  );
});

test('Alt with an arrow key in the field of a priority moves the run, and the priority stays', async () => {
  const { user } = openPage('/queue');
  await user.click(await screen.findByRole('textbox', { name: /^Priority of .* seed 2$/ }));
  await user.keyboard('{Alt>}{ArrowDown}{/Alt}');
  await waitFor(() => expect(server.bodiesOf('POST', '/api/runs/run-2/move')).toEqual([{ before: null }]));
  await user.tab();
  expect(server.bodiesOf('PUT', '/api/runs/priority')).toEqual([]);
});

test('a priority that is refused is not sent again when the field is left', async () => {
  server.on('PUT /api/runs/priority', () => problem(409, null, 'It has ended.'));
  const { user } = openPage('/queue');
  const field = await screen.findByRole<HTMLInputElement>('textbox', { name: /^Priority of .* seed 2$/ });
  await user.clear(field);
  await user.type(field, '5{Enter}');
  await waitFor(() => expect(field.value).toBe('0'));
  await user.tab();
  expect(server.bodiesOf('PUT', '/api/runs/priority')).toHaveLength(1);
});

test('an empty queue says what to do', async () => {
  server.on('GET /api/queue', () => ({ body: { entries: [], total: 0 } }));
  openPage('/queue');
  expect(await screen.findByText('Nothing runs and nothing waits')).toBeTruthy();
});
