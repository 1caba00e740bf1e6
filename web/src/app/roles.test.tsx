import { screen, within } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import type { FakeServer } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { DETAIL, STUDY } from '@/testing/samples';

const NOTE = /you see everything and change nothing/;

let server: FakeServer;
beforeEach(() => {
  server = startServer()
    .on('GET /api/studies', () => ({ body: { studies: [STUDY] } }))
    .on('GET /api/studies/study-1', () => ({ body: STUDY }));
});

function be(role: string) {
  const caller = { name: 'ada', role, has_account: true };
  server.on('GET /api/auth/me', () => ({ body: { mode: 'accounts', caller, message: null } }));
}

function button(name: string | RegExp): HTMLElement | null {
  return screen.queryByRole('button', { name });
}

test('a viewer is told once why there is nothing to change', async () => {
  be('viewer');
  openPage('/studies');
  expect(await screen.findByText(NOTE)).toBeTruthy();
  const rail = within(screen.getByRole('navigation', { name: 'Main' }));
  expect(rail.queryByRole('link', { name: 'New run' })).toBeNull();
  expect(rail.getByRole('link', { name: 'Queue' })).toBeTruthy();
});

test.each(['operator', 'admin'])('an %s finds every way to launch', async (role) => {
  be(role);
  openPage('/studies');
  expect(await screen.findByRole('link', { name: 'New study' })).toBeTruthy();
  expect(screen.getByRole('link', { name: 'New run' })).toBeTruthy();
  expect(button('Upload a study file')).toBeTruthy();
  expect(screen.queryByText(NOTE)).toBeNull();
});

test('a viewer sees a study and may compare it, nothing else', async () => {
  be('viewer');
  openPage('/studies/study-1');
  await screen.findByText(NOTE);
  const page = within(await screen.findByRole('main'));
  expect(await page.findByRole('link', { name: 'Compare' })).toBeTruthy();
  expect(page.getByRole('link', { name: 'Export' })).toBeTruthy();
  for (const name of ['Delete', 'Edit', 'Add seeds …', /^Fill/, /^Retry/]) expect(button(name)).toBeNull();
});

test('a viewer may look at what a launch would do, and reads why the button is off', async () => {
  be('viewer');
  server.on('POST /api/launches/plan', () => ({ body: { runs: [] } }));
  openPage('/launch?task=FetchPush&method=her');
  await screen.findByText(NOTE);
  expect(await screen.findByText(/Your role may look, not launch/)).toBeTruthy();
  const launch = await screen.findByRole('button', { name: /^(Launch|Open what exists)/ });
  expect(launch.hasAttribute('disabled')).toBe(true);
});

test('a viewer finds no launches in the palette', async () => {
  be('viewer');
  const { user } = openPage('/studies');
  await screen.findByText(NOTE);
  await user.click(button('Find anything') as HTMLElement);
  expect(await screen.findByRole('option', { name: /^Queue/ })).toBeTruthy();
  expect(screen.queryByRole('option', { name: /^Launch FetchPush/ })).toBeNull();
  expect(screen.queryByRole('option', { name: /^New/ })).toBeNull();
});

test('a viewer can neither end, label nor delete a run', async () => {
  be('viewer');
  server.on('GET /api/runs/run-1', () => ({ body: DETAIL }));
  openPage('/runs/run-1?tab=config');
  await screen.findByText(NOTE);
  expect(await screen.findByRole('tab', { name: 'Config' })).toBeTruthy();
  for (const name of ['Actions', 'Pause', 'Add tags', 'Add notes']) expect(button(name)).toBeNull();
});
