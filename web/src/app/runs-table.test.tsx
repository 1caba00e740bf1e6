import { screen, waitFor, within } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import { DONE, type FakeServer } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { DETAIL, RUN } from '@/testing/samples';

const MANY = 1000;
const FEW = 5;
const GROUP = {
  keys: { task: 'FetchPush', method: 'her-sldr' },
  runs: 3,
  seeds: [0, 1, 2],
  states: { succeeded: 2, running: 1 },
  spread: { n: 3, lower: 0.5, median: 0.75, upper: 0.8 },
};

/** Runs from one row on, each with its row as its seed. */
function page(url: URL, total: number) {
  const offset = Number(url.searchParams.get('offset') ?? 0);
  const limit = Number(url.searchParams.get('limit') ?? 50);
  const rows = Array.from({ length: Math.min(limit, total - offset) }, (_, i) => offset + i);
  const columns = url.searchParams.getAll('column');
  return {
    runs: rows.map((seed) => ({ ...RUN, id: `run-${seed}`, seed, tags: seed === 0 ? ['good'] : [] })),
    values: rows.map(() => columns.map(() => 0.5)),
    next_cursor: null,
    total,
  };
}

let server: FakeServer;
beforeEach(() => {
  server = startServer()
    .on('GET /api/runs', ({ url }) => ({ body: page(url, FEW) }))
    .on('GET /api/run-groups', () => ({ body: { groups: [GROUP], total: 3 } }))
    .on('GET /api/metric-names', () => ({ body: { names: ['test/success_rate', 'critic/task/loss'] } }))
    .on('POST /api/runs/tags', () => DONE);
});

function withRuns(total: number): void {
  server.on('GET /api/runs', ({ url }) => ({ body: page(url, total) }));
}

const lastQuery = (path = '/api/runs'): URLSearchParams =>
  new URLSearchParams(server.asked.findLast((asked) => asked.path === path)?.search);

test('of a thousand runs only those in view are drawn', async () => {
  withRuns(MANY);
  openPage('/');
  expect(await screen.findByText('1 000 runs')).toBeTruthy();
  await screen.findByRole('checkbox', { name: /seed 0$/ });
  expect(document.querySelectorAll('[data-run]').length).toBeLessThan(60);
  expect(screen.getByRole('table', { name: 'Runs' }).getAttribute('aria-rowcount')).toBe('1001');
});

test('End goes to the last run, which is fetched then', async () => {
  withRuns(MANY);
  const { user } = openPage('/');
  (await screen.findByRole('checkbox', { name: /seed 0$/ })).focus();
  await user.keyboard('{End}');
  await waitFor(() => expect(document.activeElement?.getAttribute('aria-label')).toMatch(/seed 999$/));
});

test('Enter opens the run', async () => {
  server.on('GET /api/runs/run-1', () => ({ body: { ...DETAIL, id: 'run-1' } }));
  const { user, router } = openPage('/');
  (await screen.findByRole('checkbox', { name: /seed 0$/ })).focus();
  await user.keyboard('{ArrowDown}{Enter}');
  await waitFor(() => expect(router.state.location.pathname).toBe('/runs/run-1'));
});

test('all runs can be selected and tagged at once', async () => {
  const { user } = openPage('/');
  await user.click(await screen.findByRole('checkbox', { name: 'Select all runs of this table' }));
  const bar = await screen.findByRole('toolbar', { name: 'Selected runs' });
  expect(within(bar).getByText('5 runs selected')).toBeTruthy();
  await user.click(within(bar).getByRole('button', { name: 'Tags' }));
  await user.type(await screen.findByPlaceholderText('Type, then Enter'), 'ok{Enter}');
  await user.click(screen.getByRole('button', { name: /^Change the tags/ }));
  await waitFor(() => expect(server.bodiesOf('POST', '/api/runs/tags')).toHaveLength(1));
  const [sent] = server.bodiesOf('POST', '/api/runs/tags') as { run_ids: string[]; add: string[] }[];
  expect([sent?.run_ids.length, sent?.add]).toEqual([FEW, ['ok']]);
});

test('a few selected runs lead to their comparison', async () => {
  const { user } = openPage('/');
  await user.click(await screen.findByRole('checkbox', { name: /seed 1$/ }));
  await user.click(await screen.findByRole('checkbox', { name: /seed 3$/ }));
  const bar = within(await screen.findByRole('toolbar', { name: 'Selected runs' }));
  expect(bar.getByRole('link', { name: 'Compare' }).getAttribute('href')).toBe('/compare?runs=run-1,run-3');
  expect(bar.getByRole('link', { name: 'Differences' }).getAttribute('href')).toBe('/compare/configs?runs=run-1,run-3');
});

test('selected locomotion runs are compared as such, beside others not at all', async () => {
  const runs = ['manipulation', 'locomotion', 'locomotion'].map((phase, seed) => ({
    ...RUN,
    id: `run-${seed}`,
    seed,
    phase,
  }));
  server.on('GET /api/runs', () => ({ body: { runs, values: [[], [], []], next_cursor: null, total: 3 } }));
  const { user } = openPage('/');
  await user.click(await screen.findByRole('checkbox', { name: /seed 1$/ }));
  await user.click(await screen.findByRole('checkbox', { name: /seed 2$/ }));
  const link = within(await screen.findByRole('toolbar', { name: 'Selected runs' })).getByRole('link', {
    name: 'Compare',
  });
  expect(link.getAttribute('href')).toBe('/compare?runs=run-1,run-2&phase=locomotion');
  await user.click(await screen.findByRole('checkbox', { name: /seed 0$/ }));
  expect(link.getAttribute('href')).toBe('/compare?runs=run-0');
  expect(link.title).toBe('Compares the manipulation runs alone');
});

test('selected runs out of view are let go by an action, for nobody tells how they stand now', async () => {
  withRuns(MANY);
  server.on('POST /api/runs/actions', ({ body }) => ({
    body: {
      results: (body as { run_ids: string[] }).run_ids.map((run_id) => ({ run_id, done: true, message: 'Done.' })),
    },
  }));
  const { user } = openPage('/');
  await user.click(await screen.findByRole('checkbox', { name: 'Select all runs of this table' }));
  const bar = within(await screen.findByRole('toolbar', { name: 'Selected runs' }));
  expect(bar.getByText(/^1\s000 runs selected$/)).toBeTruthy();
  await user.click(bar.getByRole('button', { name: /^Pause/ }));
  expect(await bar.findByText(/^(50|100) runs selected$/)).toBeTruthy();
});

test('filters are chips that can be taken away', async () => {
  const { user, router } = openPage('/?state=queued,running&seed_from=2');
  const chips = within(await screen.findByRole('list', { name: 'Filters' }));
  expect(chips.getByText('state queued, running')).toBeTruthy();
  await waitFor(() => expect(lastQuery().getAll('state')).toEqual(['queued', 'running']));
  await user.click(chips.getByRole('button', { name: 'Remove the filter seed from 2' }));
  await waitFor(() => expect(router.state.location.search).toEqual({ state: 'queued,running' }));
});

test('a click on a tag narrows the table to it', async () => {
  const { user, router } = openPage('/');
  await user.click(await screen.findByRole('button', { name: /good$/ }));
  await waitFor(() => expect(router.state.location.search).toMatchObject({ tag: 'good' }));
});

test('a metric becomes a column that sorts', async () => {
  const { user } = openPage('/?columns=critic/task/loss:mean5');
  await user.click(await screen.findByRole('button', { name: /critic\/task\/loss/ }));
  await waitFor(() => expect(lastQuery().get('sort')).toBe('critic/task/loss:mean5'));
  await user.click(screen.getByRole('button', { name: 'Columns' }));
  await user.click(await screen.findByRole('combobox', { name: 'Metric' }));
  await user.click(await screen.findByRole('option', { name: 'test/success_rate' }));
  await user.click(screen.getByRole('button', { name: 'Add' }));
  await waitFor(() => expect(lastQuery().getAll('column')).toContain('test/success_rate:last'));
});

test('a group shows its spread, opens to its runs, and stays open in the address', async () => {
  const { user, router } = openPage('/?group=task,method');
  expect(await screen.findByText('75.0 %')).toBeTruthy();
  expect(screen.getByText('seeds 0–2')).toBeTruthy();
  await user.click(screen.getByRole('button', { name: 'FetchPush · her-sldr' }));
  expect(await screen.findByRole('checkbox', { name: /seed 0$/ })).toBeTruthy();
  expect(lastQuery().getAll('method')).toEqual(['her-sldr']);
  expect(router.state.location.search).toMatchObject({ open: 'FetchPush|her-sldr' });
});

test('the arrow keys go past the link to the rest of a group', async () => {
  const groups = ['her', 'ddpg'].map((method) => ({ ...GROUP, keys: { method } }));
  const runs = [0, 1].map((seed) => ({ ...RUN, id: `run-${seed}`, seed }));
  server
    .on('GET /api/run-groups', () => ({ body: { groups, total: 63 } }))
    .on('GET /api/runs', () => ({ body: { runs, values: [[], []], next_cursor: null, total: 60 } }));
  const { user } = openPage('/?group=method&open=her');
  (await screen.findByRole('checkbox', { name: /seed 1$/ })).focus();
  await user.keyboard('{ArrowDown}');
  const link = screen.getByRole('link', { name: 'Show all, 58 runs more' });
  expect(document.activeElement).toBe(link);
  expect(link.tabIndex).toBe(0);
  await user.keyboard('{ArrowDown}');
  expect(document.activeElement?.getAttribute('aria-label')).toMatch(/ddpg/);
});

test('a line that comes late takes no focus that has gone elsewhere', async () => {
  let answer: () => void = () => {};
  const later = new Promise<void>((resolve) => {
    answer = resolve;
  });
  server.on('GET /api/runs', async ({ url }) => {
    if (url.searchParams.get('offset') !== '0') await later;
    return { body: page(url, MANY) };
  });
  const { user } = openPage('/');
  (await screen.findByRole('checkbox', { name: /seed 0$/ })).focus();
  await user.keyboard('{End}');
  const field = screen.getByRole('searchbox', { name: 'Search runs' });
  await user.click(field);
  answer();
  await screen.findByRole('checkbox', { name: /seed 999$/ });
  expect(document.activeElement).toBe(field);
});

test('selecting a closed group asks how its runs stand now', async () => {
  const { user } = openPage('/?group=task,method');
  const head = await screen.findByRole('button', { name: 'FetchPush · her-sldr' });
  await user.click(head);
  await screen.findByRole('checkbox', { name: /seed 0$/ });
  await user.click(head);
  await waitFor(() => expect(screen.queryByRole('checkbox', { name: /seed 0$/ })).toBeNull());
  server.on('GET /api/runs', ({ url }) => {
    const answer = page(url, FEW);
    return { body: { ...answer, runs: answer.runs.map((run) => ({ ...run, state: 'failed' })) } };
  });
  await user.click(screen.getByRole('checkbox', { name: /FetchPush · her-sldr/ }));
  const bar = within(await screen.findByRole('toolbar', { name: 'Selected runs' }));
  expect(bar.getByRole('button', { name: /^Retry/ })).toBeTruthy();
});

test('notes are plain text and can be changed', async () => {
  const notes = '<b id="bold">not bold</b>';
  server.on('GET /api/runs/run-1', () => ({ body: { ...DETAIL, notes } })).on('PUT /api/runs/run-1/notes', () => DONE);
  const { user } = openPage('/runs/run-1');
  expect(await screen.findByText(notes)).toBeTruthy();
  expect(document.querySelector('#bold')).toBeNull();
  await user.click(screen.getByRole('button', { name: 'Edit notes' }));
  const field = await screen.findByRole('textbox', { name: /^Notes/ });
  await user.clear(field);
  await user.type(field, 'fine');
  await user.click(screen.getByRole('button', { name: 'Save' }));
  await waitFor(() => expect(server.bodiesOf('PUT', '/api/runs/run-1/notes')).toEqual([{ notes: 'fine' }]));
});
