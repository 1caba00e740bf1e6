import { screen, waitFor, within } from '@testing-library/react';
import { beforeEach, expect, test, vi } from 'vitest';
import { NO_METRICS } from '@/lib/metrics';
import { EPISODE, EPISODES, TIMELINES } from '@/testing/episode-samples';
import { type FakeServer, problem } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { DETAIL } from '@/testing/samples';

const METRICS = {
  ...NO_METRICS,
  cursor: 2,
  attempt: [1, 1],
  step: [1, 2],
  epoch: [1, 2],
  env_steps: [1, 2],
  episodes: [1, 2],
  updates: [1, 2],
  wall_seconds: [1, 2],
  values: { 'episodes/success_share': [0, 0.5], 'episodes/too_slow_share': [1, 0.5] },
};

let server: FakeServer;
beforeEach(() => {
  server = startServer()
    .on('GET /api/runs/run-1', () => ({ body: DETAIL }))
    .on('GET /api/runs/run-1/metrics', () => ({ body: METRICS }))
    .on('GET /api/runs/run-1/episodes', () => ({ body: EPISODES }))
    .on('GET /api/runs/run-1/episodes/2/0', () => ({ body: TIMELINES }));
});

const asked = (): string[] => server.asked.filter(({ path }) => path.endsWith('/episodes')).map(({ search }) => search);

test('episodes are listed with how they ended, and sorted by a press on a head', async () => {
  const { user } = openPage('/runs/run-1?tab=episodes');
  const table = within(await screen.findByRole('table', { name: 'Recorded episodes' }));
  expect(table.getByText('too slow')).toBeTruthy();
  expect(table.getByText('to the same bits')).toBeTruthy();
  expect(table.getByText('differently')).toBeTruthy();
  await user.click(table.getByRole('button', { name: 'Worst q' }));
  await waitFor(() => expect(asked().at(-1)).toContain('sort=worst_q&descending=false'));
});

test('one episode shows its timelines, says whether it simulates again, and leads to 3D', async () => {
  const { user, router } = openPage('/runs/run-1?tab=episodes');
  await user.click(await screen.findByRole('button', { name: 'Episode 2.0' }));
  const episode = within(await screen.findByRole('region', { name: 'Episode 2.0' }));
  expect(episode.getByRole('figure', { name: 'q' })).toBeTruthy();
  expect(episode.getByText(/came to the same states, to the last bit/)).toBeTruthy();
  expect(router.state.location.search).toMatchObject({ tab: 'episodes', episode: '2.0' });
  const link = episode.getByRole('link', { name: 'Watch in 3D' });
  expect(link.getAttribute('href')).toBe('/runs/run-1?tab=3d&episode=2.0');
});

test('the way into 3D keeps what the list is narrowed to', async () => {
  openPage('/runs/run-1?tab=episodes&tag=too_slow&smooth=0.5');
  const link = await screen.findByRole('link', { name: 'Watch episode 2.0 in 3D' });
  const { searchParams } = new URL(link.getAttribute('href') ?? '', window.location.origin);
  expect(Object.fromEntries(searchParams)).toEqual({ tab: '3d', episode: '2.0', tag: 'too_slow', smooth: '0.5' });
});

test('the chart of shares is read with the arrow keys, and narrows the list to a test', async () => {
  const { user } = openPage('/runs/run-1?tab=episodes');
  const chart = await screen.findByRole('slider', { name: 'How test episodes ended, by epoch' });
  expect(chart.getAttribute('aria-valuetext')).toBe('epoch 2: success 50\u202f%, too slow 50\u202f%');
  chart.focus();
  await user.keyboard('{ArrowLeft}');
  expect(chart.getAttribute('aria-valuetext')).toBe('epoch 1: too slow 100\u202f%');
  await user.keyboard('{Enter}');
  await waitFor(() => expect(asked().at(-1)).toContain('epoch=1'));
});

test('another order leaves the page where it stands, another tab begins at its top', async () => {
  const { user, router } = openPage('/runs/run-1?tab=episodes');
  const head = await screen.findByRole('button', { name: 'Worst q' });
  const scrolling = vi.spyOn(window, 'scrollTo');
  await user.click(head);
  await waitFor(() => expect(router.state.resolvedLocation?.search).toMatchObject({ sort: 'worst_q' }));
  expect(scrolling).not.toHaveBeenCalled();
  await user.click(screen.getByRole('tab', { name: 'Config' }));
  await waitFor(() => expect(scrolling).toHaveBeenCalled());
});

test('more episodes are those that follow, so that no answer grows beyond what the server gives', async () => {
  server.on('GET /api/runs/run-1/episodes', ({ url }) => {
    const offset = Number(url.searchParams.get('offset'));
    const rows = [offset, offset + 1].map((index) => ({ ...EPISODE, index }));
    return { body: { episodes: rows, total: 4, epochs: [2] } };
  });
  const { user } = openPage('/runs/run-1?tab=episodes');
  await user.click(await screen.findByRole('button', { name: 'Show more of 4 episodes' }));
  expect(await screen.findByRole('button', { name: 'Episode 2.3' })).toBeTruthy();
  expect(screen.getByRole('button', { name: 'Episode 2.0' })).toBeTruthy();
  expect(screen.queryByRole('button', { name: /^Show more/ })).toBeNull();
  expect(asked().at(-1)).toContain('limit=50&offset=2');
});

test('a file that cannot be read is told in its own words', async () => {
  server.on('GET /api/runs/run-1/episodes/2/0', () => problem(422, null, 'The file is cut short.'));
  openPage('/runs/run-1?tab=episodes&episode=2.0');
  expect(await screen.findByText('The file is cut short.', {}, { timeout: 15_000 })).toBeTruthy();
});

test('before the first test it says what will come', async () => {
  server.on('GET /api/runs/run-1/episodes', () => ({ body: { episodes: [], total: 0, epochs: [] } }));
  openPage('/runs/run-1?tab=episodes');
  expect(await screen.findByText('No episodes yet')).toBeTruthy();
});
