import { screen, waitFor, within } from '@testing-library/react';
import { afterEach, beforeEach, expect, test } from 'vitest';
import type { Worker } from '@/client/schema.gen';
import { learnServerTime } from '@/lib/server-clock';
import { DONE, type FakeServer } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';

const WORKER: Worker = {
  id: 'w1',
  host: 'box-3',
  pid: 4711,
  executor: 'local',
  slots: 2,
  running: [{ id: 'run-1', task: 'FetchPush', phase: 'manipulation', method: 'her', seed: 4 }],
  cores: 16,
  processor: 'AMD EPYC 7003',
  gpu: 'H200',
  memory_total: 32e9,
  memory_used: 8e9,
  draining: false,
  last_heartbeat_at: new Date().toISOString(),
  alive: true,
};

let server: FakeServer;
beforeEach(() => {
  server = startServer().on('PUT /api/workers/w1/draining', () => DONE);
});

// The clock of a server is known to all tests of this process.
afterEach(() => learnServerTime(new Date().toUTCString(), Date.now(), Date.now()));

function openWorkers(...workers: Worker[]) {
  server.on('GET /api/workers', () => ({ body: { workers } }));
  return openPage('/workers');
}

test('a worker shows what it has and leads to what it trains', async () => {
  openWorkers(WORKER);
  const list = within(await screen.findByRole('list', { name: 'Workers' }));
  for (const text of ['box-3', '1 of 2', '16 of AMD EPYC 7003', 'H200', '8 GB of 32 GB'])
    expect(list.getByText(text)).toBeTruthy();
  const link = list.getByRole('link', { name: 'FetchPush manipulation, her, seed 4' });
  expect(link.getAttribute('href')).toBe('/runs/run-1');
  expect(screen.getByText('1 alive · 1 of 2 slots busy')).toBeTruthy();
});

test('draining tells the server, and says what it means', async () => {
  const { user } = openWorkers(WORKER);
  await user.click(await screen.findByRole('button', { name: 'Drain' }));
  await waitFor(() => expect(server.bodiesOf('PUT', '/api/workers/w1/draining')).toEqual([{ draining: true }]));
  expect(await screen.findByText('box-3 takes no further run and keeps those that it has.')).toBeTruthy();
});

test('a draining worker can take runs again', async () => {
  const { user } = openWorkers({ ...WORKER, draining: true });
  await user.click(await screen.findByRole('button', { name: 'Take runs again' }));
  await waitFor(() => expect(server.bodiesOf('PUT', '/api/workers/w1/draining')).toEqual([{ draining: false }]));
});

test('a worker that is gone says so and cannot be drained', async () => {
  openWorkers({ ...WORKER, alive: false, running: [], last_heartbeat_at: '2026-01-01T10:00:00Z' });
  expect(await screen.findByText(/^gone, /)).toBeTruthy();
  expect(screen.queryByRole('button', { name: 'Drain' })).toBeNull();
});

test.each([60_000, -60_000])(
  'by a browser clock that is %d ms ahead a worker is neither late nor early',
  async (ahead) => {
    const told = Date.now() - ahead;
    server.on('GET /api/workers', () => ({
      body: { workers: [{ ...WORKER, last_heartbeat_at: new Date(told - 5_000).toISOString() }] },
      headers: { date: new Date(told).toUTCString() },
    }));
    openPage('/workers');
    expect(await screen.findByText(/^alive, [4-9] s ago$/)).toBeTruthy();
  },
);
