import { cleanup, screen, waitFor } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import type { Video } from '@/client/schema.gen';
import { NO_METRICS } from '@/lib/metrics';
import { type FakeServer, problem } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { DETAIL } from '@/testing/samples';

const VIDEO: Video = {
  id: 'v1',
  run_id: 'run-1',
  epoch: null,
  number: 0,
  width: 640,
  height: 480,
  name: 'video-newest-policy-episode-0-640x480.mp4',
  state: 'queued',
  reason: null,
  url: null,
  created_at: '2026-01-01T10:00:00Z',
};

let server: FakeServer;
let videos: Video[];
beforeEach(() => {
  videos = [];
  server = startServer()
    .on('GET /api/runs/run-1', () => ({ body: { ...DETAIL, has_policy: true } }))
    .on('GET /api/runs/run-1/metrics', () => ({ body: NO_METRICS }))
    .on('GET /api/runs/run-1/files', () => ({ body: { files: [] } }))
    .on('GET /api/runs/run-1/videos', () => ({ body: { videos } }));
});

test('a video is ordered at the chosen size, and waited for', async () => {
  server.on('POST /api/runs/run-1/videos', () => {
    videos = [VIDEO];
    return { status: 202, body: VIDEO };
  });
  const { user } = openPage('/runs/run-1?tab=videos');
  await user.selectOptions(await screen.findByRole('combobox', { name: 'Size of the video' }), 'small');
  await user.click(screen.getByRole('button', { name: 'Film the newest policy' }));
  expect(await screen.findByText('Waiting to be drawn')).toBeTruthy();
  expect(server.bodiesOf('POST', '/api/runs/run-1/videos')).toEqual([
    { epoch: null, number: 0, format: 'mp4', width: 480, height: 360 },
  ]);
});

test('a video that is done is played, one that failed says why and is tried again', async () => {
  videos = [
    { ...VIDEO, state: 'done', url: '/api/runs/run-1/files/a.mp4', epoch: 3, number: 1 },
    { ...VIDEO, id: 'v2', state: 'failed', reason: 'MuJoCo cannot draw off screen here.' },
  ];
  server.on('POST /api/runs/run-1/videos', () => ({ status: 202, body: VIDEO }));
  const { user } = openPage('/runs/run-1?tab=videos');
  const player = await screen.findByLabelText('Epoch 3, episode 1');
  expect(player.getAttribute('src')).toBe('/api/runs/run-1/files/a.mp4');
  expect(screen.getByText('MuJoCo cannot draw off screen here.')).toBeTruthy();
  await user.click(screen.getByRole('button', { name: 'Try again' }));
  await waitFor(() => expect(server.bodiesOf('POST', '/api/runs/run-1/videos')).toHaveLength(1));
});

test('whoever may not film is not offered to try again, and a refusal is told', async () => {
  videos = [{ ...VIDEO, state: 'failed', reason: 'MuJoCo cannot draw off screen here.' }];
  server.on('POST /api/runs/run-1/videos', () => problem(409, null, 'Its policy is gone.'));
  const { user } = openPage('/runs/run-1?tab=videos');
  await user.click(await screen.findByRole('button', { name: 'Try again' }));
  expect(await screen.findByText('Its policy is gone.')).toBeTruthy();
  cleanup();
  const caller = { name: 'ada', role: 'viewer', has_account: true };
  server.on('GET /api/auth/me', () => ({ body: { mode: 'accounts', caller, message: null } }));
  openPage('/runs/run-1?tab=videos');
  await screen.findByText('MuJoCo cannot draw off screen here.');
  await waitFor(() => expect(screen.queryByRole('button', { name: 'Try again' })).toBeNull());
});

test('what the server refuses is told', async () => {
  server.on('POST /api/runs/run-1/videos', () => problem(409, null, 'It has no policy to film yet.'));
  const { user } = openPage('/runs/run-1?tab=videos');
  await user.click(await screen.findByRole('button', { name: 'Film the newest policy' }));
  expect(await screen.findByText('It has no policy to film yet.')).toBeTruthy();
});

test('a run without a recording says when there will be one', async () => {
  openPage('/runs/run-1?tab=rerun');
  expect(await screen.findByText(/appears after the first test/)).toBeTruthy();
});
