import { screen, waitFor, within } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import { BEST, COMPARISON } from '@/testing/comparison';
import type { FakeServer } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';

let server: FakeServer;
beforeEach(() => {
  server = startServer()
    .on('GET /api/compare', () => ({ body: COMPARISON }))
    .on('GET /api/compare/best', () => ({ body: BEST }))
    .on('GET /api/compare/metrics', () => ({ body: { metrics: ['critic/task/loss', 'test/success_rate'] } }));
});

/** What the server was last asked for. */
function lastAsked(path: string): URLSearchParams {
  return new URLSearchParams(server.asked.findLast((asked) => asked.path === path)?.search);
}

test('a panel says statistic, seeds and level, also of those with too few seeds', async () => {
  openPage('/compare');
  const panel = within(await screen.findByRole('figure', { name: 'FetchPush' }));
  expect(panel.getByText(/^HER-Sparse: 1 seed/)).toBeTruthy();
  expect(panel.getByText('1 curve of another kind')).toBeTruthy();
  expect(panel.getByText(/^HER-Sparse\+SLDR: median of 2 to 4 seeds, band: quartiles/)).toBeTruthy();
  expect(panel.getByRole('slider', { name: 'FetchPush: test success rate over epoch' })).toBeTruthy();
});

test('the statistic is asked of the server and stands in the address', async () => {
  const { user, router } = openPage('/compare?x=env_steps');
  await user.click(await screen.findByRole('radio', { name: 'IQM' }));
  await waitFor(() => expect(lastAsked('/api/compare').get('statistic')).toBe('iqm'));
  expect(lastAsked('/api/compare').get('x')).toBe('env_steps');
  expect(router.state.location.search).toMatchObject({ statistic: 'iqm', x: 'env_steps' });
  expect(await screen.findByRole('combobox', { name: 'Confidence level' })).toBeTruthy();
});

test('an address opens the same view: filters, table and pin', async () => {
  openPage('/compare?tasks=FetchPush&methods=her,her-sldr&tables=FetchPush&pin=her-sldr');
  const table = within(await screen.findByRole('table', { name: 'FetchPush: Test success rate' }));
  expect(table.getByText('HER-Sparse, seed 7')).toBeTruthy();
  expect(table.getByText('90.0 %')).toBeTruthy();
  expect(screen.getByRole('button', { name: 'HER-Sparse+SLDR' }).getAttribute('aria-pressed')).toBe('true');
  expect(lastAsked('/api/compare').getAll('method')).toEqual(['her', 'her-sldr']);
  expect(screen.getByRole('link', { name: 'seed 7' }).getAttribute('href')).toBe('/runs/run-7');
});

test('what is left out is told, with the reason', async () => {
  server.on('GET /api/compare', () => ({ body: { ...COMPARISON, every: 2 } }));
  openPage('/compare');
  expect(await screen.findByText('1 run not shown')).toBeTruthy();
  expect(screen.getByText(/only one cycle in 2 is read/)).toBeTruthy();
  expect(screen.getByText(/It has not logged test\/success_rate yet/)).toBeTruthy();
});

test('the best models come as figures, each with a table behind it', async () => {
  const { user, router } = openPage('/compare?tab=best');
  const bars = within(await screen.findByRole('list', { name: 'FetchPush' }));
  expect(bars.getByText('HER-Sparse+SLDR: 90.0 % (85.0 % to 95.0 %), n 3')).toBeTruthy();
  const cell = within(screen.getByRole('figure', { name: 'Probability of improvement' })).getByText('98 %');
  expect(cell.getAttribute('data-sure')).toBe('true');
  expect(within(screen.getByRole('figure', { name: 'Efficiency' })).getByText('57k')).toBeTruthy();
  const overall = within(screen.getByRole('figure', { name: 'Over all tasks' }));
  await user.click(overall.getByRole('button', { name: 'Show table' }));
  expect(await overall.findByRole('table', { name: 'Best test success over all shared tasks' })).toBeTruthy();
  expect(router.state.location.search).toMatchObject({ tables: 'overall' });
});

test('nothing to compare says what to do', async () => {
  server.on('GET /api/compare', () => ({ body: { ...COMPARISON, panels: [], groups: [], runs: 0 } }));
  openPage('/compare');
  expect(await screen.findByText('No run to compare')).toBeTruthy();
});

test('from what differs between locomotion runs the way leads to their curves', async () => {
  const runs = [0, 1].map((seed) => ({
    run_id: `run-${seed}`,
    task: 'FetchPush',
    phase: 'locomotion',
    method: 'her',
    seed,
    preset: 'quick',
  }));
  server.on('GET /api/compare/configs', () => ({ body: { runs, settings: [], shared: 42, methods: [] } }));
  openPage('/compare/configs?runs=run-0,run-1');
  await screen.findByText('The runs have the same config.');
  const link = screen.getByRole('link', { name: 'Compare their curves' });
  expect(link.getAttribute('href')).toBe('/compare?runs=run-0%2Crun-1&phase=locomotion');
});

test('the switches between methods and the settings that differ are listed', async () => {
  const runs = ['her', 'her-sldr'].map((method, seed) => ({
    run_id: `run-${seed}`,
    task: 'FetchPush',
    phase: 'manipulation',
    method,
    seed,
    preset: 'quick',
  }));
  const switches = [{ name: 'auxiliary', title: 'further rewards', first: 'none', second: 'sldr' }];
  const settings = [{ name: 'agent.gamma', values: ['0.98', null] }];
  server.on('GET /api/compare/configs', () => ({
    body: { runs, settings, shared: 41, methods: [{ first: 'her', second: 'her-sldr', switches }] },
  }));
  openPage('/compare/configs?runs=run-0,run-1');
  expect(await screen.findByText('further rewards')).toBeTruthy();
  expect(screen.getByText('agent.gamma')).toBeTruthy();
  expect(screen.getByText('41 further settings are alike and not shown.')).toBeTruthy();
});
