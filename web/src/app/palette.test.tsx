import { screen, waitFor } from '@testing-library/react';
import { expect, test } from 'vitest';
import { openPage, startServer } from '@/testing/open-page';
import { RUN } from '@/testing/samples';

test('before the answer has come, Enter opens no run of the answer before it', async () => {
  const wanted = { ...RUN, id: 'deadbeef', seed: 7 };
  let answer = (): void => {};
  const asked = new Promise<void>((resolve) => {
    answer = resolve;
  });
  startServer().on('GET /api/runs', async ({ url }) => {
    const isSearch = url.searchParams.has('search');
    if (isSearch) await asked;
    return { body: { runs: [isSearch ? wanted : RUN], values: [[]], next_cursor: null, total: 1 } };
  });
  const { user, router } = openPage('/settings');
  await user.click(await screen.findByRole('button', { name: 'Find anything' }));
  await screen.findByRole('option', { name: /seed 0/ });
  await user.paste('deadbeef');
  await user.keyboard('{Enter}');
  // Longer than the rest after typing: the server has been asked, and has not answered yet.
  await new Promise((resolve) => setTimeout(resolve, 400));
  await user.keyboard('{Enter}');
  expect(router.state.location.pathname).toBe('/settings');
  answer();
  await screen.findByRole('option', { name: /seed 7/ });
  await user.keyboard('{Enter}');
  await waitFor(() => expect(router.state.location.pathname).toBe('/runs/deadbeef'));
});
