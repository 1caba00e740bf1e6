import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import { DONE, type FakeServer, problem } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { RUN } from '@/testing/samples';

const SAVED = { id: 'v1', name: 'Failures', search: 'state=failed', created_at: RUN.created_at };

let server: FakeServer;
beforeEach(() => {
  server = startServer()
    .on('GET /api/runs', () => ({ body: { runs: [RUN], values: [[]], next_cursor: null, total: 1 } }))
    .on('GET /api/metric-names', () => ({ body: { names: [] } }))
    .on('GET /api/views', () => ({ body: { views: [SAVED] } }))
    .on('POST /api/views', () => ({ status: 201, body: { ...SAVED, id: 'v2' } }))
    .on('PATCH /api/views/v1', () => ({ body: SAVED }))
    .on('DELETE /api/views/v1', () => DONE);
});

test('what is shown can be saved, and a saved view opened', async () => {
  const { user, router } = openPage('/?task=FetchPush');
  await user.click(await screen.findByRole('button', { name: 'Views' }));
  await user.type(await screen.findByRole('textbox', { name: 'Name of the view' }), 'Pushes{Enter}');
  await waitFor(() =>
    expect(server.bodiesOf('POST', '/api/views')).toEqual([{ name: 'Pushes', search: 'task=FetchPush' }]),
  );
  await user.click(await screen.findByRole('link', { name: 'Failures' }));
  await waitFor(() => expect(router.state.location.search).toEqual({ state: 'failed' }));
});

test('a view that is replaced or deleted can be had back', async () => {
  const { user } = openPage('/?task=FetchPush');
  await user.click(await screen.findByRole('button', { name: 'Views' }));
  await user.click(await screen.findByRole('button', { name: 'Let Failures show what is shown now' }));
  await user.click(await screen.findByRole('button', { name: 'Undo' }));
  await waitFor(() =>
    expect(server.bodiesOf('PATCH', '/api/views/v1')).toEqual([
      { search: 'task=FetchPush' },
      { search: 'state=failed' },
    ]),
  );
  await user.click(await screen.findByRole('button', { name: 'Delete the view Failures' }));
  await user.click(await screen.findByRole('button', { name: 'Undo' }));
  await waitFor(() =>
    expect(server.bodiesOf('POST', '/api/views')).toEqual([{ name: 'Failures', search: 'state=failed' }]),
  );
});

test('an undo that is refused says why, wherever one is by then', async () => {
  server.on('POST /api/views', () => problem(409, 'name', 'There is a view called so already.'));
  const { user, router } = openPage('/?task=FetchPush');
  await user.click(await screen.findByRole('button', { name: 'Views' }));
  await user.click(await screen.findByRole('button', { name: 'Delete the view Failures' }));
  const undo = await screen.findByRole('button', { name: 'Undo' });
  await act(() => router.navigate({ to: '/settings' }));
  await user.click(undo);
  expect(await screen.findByText('There is a view called so already.')).toBeTruthy();
});
