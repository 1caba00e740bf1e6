import { screen, waitFor, within } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import type { FakeServer } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { RUN, STUDY } from '@/testing/samples';

let server: FakeServer;
beforeEach(() => {
  server = startServer()
    .on('GET /api/runs', () => ({ body: { runs: [RUN], values: [[]], next_cursor: null, total: 1 } }))
    .on('GET /api/studies', () => ({ body: { studies: [STUDY] } }))
    .on('GET /api/queue', () => ({ body: { entries: [], slots: 1 } }));
});

test('control K finds a launch and opens its form, filled in', async () => {
  const { user, router } = openPage('/');
  await screen.findByRole('heading', { name: 'Runs' });
  await user.keyboard('{Control>}k{/Control}');
  const field = await screen.findByRole('combobox', { name: /^A page/ });
  await user.type(field, 'push sldr');
  const launch = await screen.findByRole('option', { name: /Launch FetchPush with her-sldr/ });
  expect(field.getAttribute('aria-activedescendant')).toBe(launch.id);
  await user.keyboard('{Enter}');
  await waitFor(() => expect(router.state.location.pathname).toBe('/launch'));
  expect(router.state.location.search).toMatchObject({ task: 'FetchPush', method: 'her-sldr', phase: 'manipulation' });
  expect(screen.queryByRole('dialog')).toBeNull();
});

test('the rail opens the palette, which knows runs and studies and asks the server for a text', async () => {
  const { user, router } = openPage('/settings');
  await user.click(await screen.findByRole('button', { name: 'Find anything' }));
  expect(await screen.findByRole('option', { name: /FetchPush manipulation, her-sldr, seed 0/ })).toBeTruthy();
  await user.type(screen.getByRole('combobox', { name: /^A page/ }), STUDY.name);
  await waitFor(() => expect(server.asked.some(({ search }) => search.includes(`search=${STUDY.name}`))).toBe(true));
  const studies = await screen.findByRole('group', { name: 'Studies' });
  await user.click(within(studies).getByRole('option'));
  await waitFor(() => expect(router.state.location.pathname).toBe(`/studies/${STUDY.id}`));
});

test('the palette says that nothing fits once the server has said so, and not before', async () => {
  let answer = () => {};
  const waited = new Promise<void>((resolve) => {
    answer = resolve;
  });
  const { user } = openPage('/settings');
  await user.click(await screen.findByRole('button', { name: 'Find anything' }));
  server.on('GET /api/runs', async () => {
    await waited;
    return { body: { runs: [], values: [], next_cursor: null, total: 0 } };
  });
  await user.type(screen.getByRole('combobox', { name: /^A page/ }), 'xyzzy');
  expect(await screen.findByText('Looking among the runs …')).toBeTruthy();
  expect(screen.queryByText(/^Nothing fits/)).toBeNull();
  answer();
  expect(await screen.findByText(/^Nothing fits/)).toBeTruthy();
});

test('g and a letter go to a page, a question mark lists the shortcuts, and neither while typing', async () => {
  const { user, router } = openPage('/');
  const search = await screen.findByRole('searchbox', { name: 'Search runs' });
  await user.type(search, 'gq?');
  expect(router.state.location.pathname).toBe('/');
  expect(screen.queryByRole('dialog')).toBeNull();
  search.blur();
  await user.keyboard('?');
  const dialog = await screen.findByRole('dialog', { name: 'Keyboard shortcuts' });
  expect(within(dialog).getByText('Play and pause')).toBeTruthy();
  await user.keyboard('{Escape}');
  await waitFor(() => expect(screen.queryByRole('dialog')).toBeNull());
  await user.keyboard('ge');
  await waitFor(() => expect(router.state.location.pathname).toBe('/settings'));
});

test('whatever had the focus has it again once the palette or the shortcuts are closed', async () => {
  const { user } = openPage('/');
  const find = await screen.findByRole('button', { name: 'Find anything' });
  await user.click(find);
  await screen.findByRole('combobox', { name: /^A page/ });
  await user.keyboard('{Escape}');
  await waitFor(() => expect(document.activeElement).toBe(find));
  await user.keyboard('?');
  const dialog = await screen.findByRole('dialog', { name: 'Keyboard shortcuts' });
  await waitFor(() => expect(dialog.contains(document.activeElement)).toBe(true));
  await user.keyboard('{Escape}');
  await waitFor(() => expect(document.activeElement).toBe(find));
});
