import { screen, waitFor, within } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import type { FakeServer } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { RUN } from '@/testing/samples';

const LOCOMOTION = { ...RUN, id: 'run-0', phase: 'locomotion' as const, method: 'her' };
const BLOCKED = {
  ...RUN,
  id: 'run-2',
  seed: 2,
  state: 'blocked' as const,
  progress: null,
  needs: ['run-0'],
  started_at: null,
};
const FAILED = { ...RUN, id: 'run-3', seed: 3, state: 'failed' as const, reason: 'The loss became NaN in epoch 3.' };

let server: FakeServer;
beforeEach(() => {
  server = startServer().on('GET /api/runs', () => ({
    body: { runs: [FAILED, BLOCKED, RUN, LOCOMOTION], values: [[], [], [], []], next_cursor: null, total: 4 },
  }));
});

test('without runs the page says what to do first', async () => {
  server.on('GET /api/runs', () => ({ body: { runs: [], values: [], next_cursor: null, total: 0 } }));
  openPage('/');
  expect(await screen.findByRole('link', { name: 'Launch the first run' })).toBeTruthy();
  const begin = screen.getByRole('link', { name: 'Begin with FetchPush and her-sldr' });
  expect(begin.getAttribute('href')).toBe(
    '/launch?task=FetchPush&phase=manipulation&method=her-sldr&preset=quick&seeds=0',
  );
});

test('a running run shows state, epoch, success and speed', async () => {
  openPage('/');
  const row = (await screen.findByRole('link', { name: 'FetchPush manipulation, her-sldr, seed 0' })).closest('tr');
  if (row === null) throw new Error('The link stands in no row.');
  const cells = within(row);
  expect(cells.getByText('running')).toBeTruthy();
  expect(cells.getByText('3/20')).toBeTruthy();
  expect(cells.getByText('42 %')).toBeTruthy();
  expect(cells.getByText('3.12k')).toBeTruthy();
  expect(cells.getByText('3m 20s')).toBeTruthy();
});

test('a blocked run leads to the locomotion run it waits for', async () => {
  openPage('/');
  const link = await screen.findByRole('link', { name: 'run-0' });
  expect(link.getAttribute('href')).toBe('/runs/run-0');
});

test('a failed run says why on its row', async () => {
  openPage('/');
  expect(await screen.findByText('The loss became NaN in epoch 3.')).toBeTruthy();
});

test('the filters of the address are asked of the server', async () => {
  openPage('/?state=running&method=her');
  await waitFor(() => expect(server.asked.some(({ path }) => path === '/api/runs')).toBe(true));
  const query = new URLSearchParams(server.asked.find(({ path }) => path === '/api/runs')?.search);
  expect(query.get('state')).toBe('running');
  expect(query.get('method')).toBe('her');
});

test('what is searched for goes into the address', async () => {
  const { user, router } = openPage('/');
  await user.type(await screen.findByRole('searchbox', { name: 'Search runs' }), 'push');
  await waitFor(() => expect(router.state.location.search).toMatchObject({ search: 'push' }));
});

test('an unknown address gets one clear sentence', async () => {
  openPage('/nowhere');
  expect(await screen.findByText('There is no such page')).toBeTruthy();
});

test('a server that is away is announced, and the rows stay', async () => {
  openPage('/');
  await screen.findByText('The loss became NaN in epoch 3.');
  server.isDown = true;
  expect(await screen.findByText(/Reconnecting/)).toBeTruthy();
  expect(screen.getByText('The loss became NaN in epoch 3.')).toBeTruthy();
});

test('a click on a column sorts on the server, and another turns the order round', async () => {
  const { user, router } = openPage('/');
  await user.click(await screen.findByRole('button', { name: /^Success/ }));
  await waitFor(() => expect(router.state.location.search).toMatchObject({ sort: 'success' }));
  await waitFor(() => expect(lastQuery().get('descending')).toBe('true'));
  await user.click(screen.getByRole('button', { name: /^Success/ }));
  await waitFor(() => expect(lastQuery().get('descending')).toBe('false'));
  expect(screen.getByRole('columnheader', { name: /Success/ }).getAttribute('aria-sort')).toBe('ascending');
});

test('deleted runs have a list of their own', async () => {
  const { user } = openPage('/');
  await user.click(await screen.findByRole('button', { name: 'Filter' }));
  await user.click(await screen.findByRole('switch', { name: /^Deleted/ }));
  await waitFor(() => expect(lastQuery().get('deleted')).toBe('true'));
});

function lastQuery(): URLSearchParams {
  return new URLSearchParams(server.asked.findLast(({ path }) => path === '/api/runs')?.search);
}
