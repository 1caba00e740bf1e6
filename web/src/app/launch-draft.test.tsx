import { act, screen, waitFor } from '@testing-library/react';
import { expect, test } from 'vitest';
import { openPage, startServer } from '@/testing/open-page';
import { DEFAULTS, DETAIL, RUN } from '@/testing/samples';

const PLANNED = { ...RUN, config: DEFAULTS, reused_run_id: null, zoo_success: null, equal_run_id: null };

test('settings that were typed are there again after a look at another page, until they are launched', async () => {
  const runs = [{ ...PLANNED, phase: 'locomotion', method: 'her' }, PLANNED];
  const server = startServer()
    .on('POST /api/launches/plan', () => ({ body: { runs } }))
    .on('POST /api/launches', () => ({ status: 201, body: { runs: [{ ...RUN, id: 'l', phase: 'locomotion' }, RUN] } }))
    .on('GET /api/runs/run-1', () => ({ body: DETAIL }));
  const { user, router } = openPage('/launch?task=FetchPush');
  await user.click(await screen.findByRole('button', { name: /Advanced settings/ }));
  const field = await screen.findByRole('textbox', { name: 'Batch size' });
  await user.clear(field);
  await user.type(field, '512');
  await act(() => router.navigate({ to: '/launch', search: { task: 'FetchPush', from: 'run-1' } }));
  expect(await screen.findByText(/^The form begins as/)).toBeTruthy();
  await act(async () => router.history.go(-1));
  await user.click(await screen.findByRole('button', { name: /Advanced settings 1 changed/ }));
  expect(await screen.findByRole('textbox', { name: 'Batch size' })).toHaveProperty('value', '512');
  await user.click(await screen.findByRole('button', { name: 'Launch 2 runs' }));
  await waitFor(() => expect(router.state.location.pathname).toBe('/runs/run-1'));
  expect(server.bodiesOf('POST', '/api/launches')).toMatchObject([{ overrides: { loop: { batch_size: 512 } } }]);
  await act(async () => router.history.go(-1));
  expect(await screen.findByRole('button', { name: /Advanced settings as the preset has them/ })).toBeTruthy();
});
