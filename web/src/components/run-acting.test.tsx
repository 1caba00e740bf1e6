import { screen, waitFor } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import type { FakeServer } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { DETAIL } from '@/testing/samples';

let server: FakeServer;
beforeEach(() => {
  server = startServer()
    .on('GET /api/runs/run-1', () => ({ body: { ...DETAIL, state: 'failed' } }))
    .on('POST /api/runs/actions', ({ body }) => {
      const { action } = body as { action: string };
      const done = action === 'delete';
      return { body: { results: [{ run_id: 'run-1', done, message: done ? 'It is deleted.' : 'It is gone.' }] } };
    });
});

/** Delete a run on its page, which leads away from it. */
async function deleteRun() {
  const { user, router } = openPage('/runs/run-1?tab=config');
  await user.click(await screen.findByRole('button', { name: 'Actions' }));
  await user.click(await screen.findByRole('menuitem', { name: /^Delete/ }));
  await waitFor(() => expect(router.state.location.pathname).toBe('/'));
  return { user, undo: await screen.findByRole('button', { name: 'Undo' }) };
}

test('an undo that is refused says so though the page that asked is gone', async () => {
  const { user, undo } = await deleteRun();
  await user.click(undo);
  expect((await screen.findByRole('alert')).textContent).toContain('It is gone.');
});

test('an undo that does not reach the server says so though the page that asked is gone', async () => {
  const { user, undo } = await deleteRun();
  server.isDown = true;
  await user.click(undo);
  expect((await screen.findByRole('alert')).textContent).toContain('The server does not answer.');
});

test('the button that led to the question has the focus again, the first time too', async () => {
  server.on('GET /api/runs/run-1', () => ({ body: DETAIL }));
  const { user } = openPage('/runs/run-1?tab=config');
  const actions = await screen.findByRole('button', { name: 'Actions' });
  for (const _ of ['loaded now', 'loaded before']) {
    actions.focus();
    await user.keyboard('{Enter}');
    (await screen.findByRole('menuitem', { name: /^Cancel/ })).focus();
    await user.keyboard('{Enter}');
    const keep = await screen.findByRole('button', { name: 'Keep it' });
    await waitFor(() => expect(document.activeElement).toBe(keep));
    await user.keyboard('{Enter}');
    await waitFor(() => expect(screen.queryByRole('dialog')).toBeNull());
    expect(document.activeElement).toBe(actions);
  }
});
