import { screen, waitFor, within } from '@testing-library/react';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import type { Notice, RetentionPreview, Webhook } from '@/client/schema.gen';
import { untold } from '@/lib/notices';
import { DONE, type FakeServer, problem } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';

const URL = 'https://chat.example.org/hooks/abc';
const WEBHOOK: Webhook = {
  id: 'w1',
  url: URL,
  events: ['run_failed'],
  created_at: '2026-01-01T00:00:00Z',
  deliveries: [
    {
      id: 'd1',
      event: 'test',
      state: 'failed',
      tries: 6,
      problem: 'The service answered with status 404.',
      created_at: '2026-01-01T00:00:00Z',
      ended_at: '2026-01-01T03:00:00Z',
      next_try_at: null,
    },
  ],
};
const PREVIEW: RetentionPreview = {
  kinds: [{ kind: 'replay', files: 2, size: 3e9 }],
  runs: [
    {
      run_id: 'run-1',
      task: 'FetchPush',
      phase: 'manipulation',
      method: 'her',
      seed: 4,
      state: 'succeeded',
      ended_at: '2026-01-01T00:00:00Z',
      files: 2,
      size: 3e9,
    },
  ],
  total_runs: 1,
  size: 3e9,
  spared_young: 2,
  spared_kept: 1,
  spared_needed: 0,
};
const NOTICE: Notice = {
  event: 'run_failed',
  subject: 'run-1',
  occasion: '1',
  at: '2026-01-01T00:00:00Z',
  message: 'Run run-1 failed.',
  path: '/runs/run-1',
};

let server: FakeServer;
beforeEach(() => {
  server = startServer()
    .on('GET /api/webhooks', () => ({ body: { webhooks: [WEBHOOK] } }))
    .on('GET /api/retention', () => ({ body: PREVIEW }))
    .on('POST /api/retention', () => ({ body: { runs: 1, files: 2, size: 3e9, left: 0 } }));
});
afterEach(() => {
  vi.unstubAllGlobals();
  vi.restoreAllMocks();
  window.localStorage.clear();
});

test('a webhook is added, its secret shown once, tested and removed', async () => {
  server
    .on('POST /api/webhooks', () => ({ status: 201, body: { ...WEBHOOK, secret: '5ec2e7' } }))
    .on('POST /api/webhooks/w1/test', () => ({ status: 202, body: WEBHOOK.deliveries[0] }))
    .on('DELETE /api/webhooks/w1', () => DONE);
  const { user } = openPage('/settings');
  await user.click(await screen.findByRole('textbox', { name: 'Address' }));
  await user.paste(URL);
  await user.click(screen.getByRole('checkbox', { name: 'A study has ended' }));
  await user.click(screen.getByRole('button', { name: 'Add' }));
  expect(await screen.findByText('5ec2e7')).toBeTruthy();
  expect(server.bodiesOf('POST', '/api/webhooks')).toEqual([{ url: URL, events: ['run_failed'] }]);
  const list = within(await screen.findByRole('list', { name: 'Webhooks' }));
  expect(list.getByText(/test: given up after 6 tries\. The service answered with status 404\./)).toBeTruthy();
  await user.click(list.getByRole('button', { name: `Send a test to ${URL}` }));
  await user.click(list.getByRole('button', { name: `Remove ${URL}` }));
  await waitFor(() => expect(server.asked.some((asked) => asked.method === 'DELETE')).toBe(true));
  expect(server.bodiesOf('POST', '/api/webhooks/w1/test')).toHaveLength(1);
});

test('an address that cannot be told is refused at its field', async () => {
  server.on('POST /api/webhooks', () => problem(422, 'url', 'it does not begin with https://'));
  const { user } = openPage('/settings');
  await user.type(await screen.findByRole('textbox', { name: 'Address' }), 'ftp://x');
  await user.click(screen.getByRole('button', { name: 'Add' }));
  expect(await screen.findByText('it does not begin with https://')).toBeTruthy();
});

test('what would go is shown before a person lets it go', async () => {
  const { user } = openPage('/settings');
  expect(await screen.findByText('3 GB would be removed')).toBeTruthy();
  expect(
    screen.getByText('Spared: 2 ended less than 30 days ago, 1 tagged to be kept, 0 that others learn from.'),
  ).toBeTruthy();
  expect(screen.getByRole('link', { name: 'FetchPush manipulation, her, seed 4' })).toBeTruthy();
  await user.click(screen.getByRole('button', { name: 'Remove …' }));
  expect(server.bodiesOf('POST', '/api/retention')).toEqual([]);
  await user.click(await screen.findByRole('button', { name: 'Remove them' }));
  expect(await screen.findByText('Removed 2 files of 1 run: 3 GB.')).toBeTruthy();
  expect(server.bodiesOf('POST', '/api/retention')).toEqual([{ kinds: ['replay'], older_than_days: 30 }]);
});

test('notifications are shown from when it is wanted, each once, and lead to the run', async () => {
  const shown: { body?: string; onclick?: () => void }[] = [];
  class Fake {
    static permission = 'default';
    static requestPermission = async () => {
      Fake.permission = 'granted';
      return 'granted';
    };
    onclick?: () => void;
    readonly body?: string;
    constructor(_: string, options: { body?: string }) {
      this.body = options.body;
      shown.push(this);
    }
  }
  vi.stubGlobal('Notification', Fake);
  vi.spyOn(window, 'focus').mockReturnValue();
  const before = { ...NOTICE, occasion: '0', at: '2025-12-31T23:00:00Z', message: 'Before the page was opened.' };
  const meanwhile = { ...NOTICE, occasion: '0b', at: '2025-12-31T23:55:00Z', message: 'Before it was wanted.' };
  // The browser's clock is fast: by the server's it has just happened.
  server.on('GET /api/notices', async () => {
    await new Promise((resolve) => setTimeout(resolve, 50));
    return { body: { notices: [before, meanwhile, NOTICE], now: NOTICE.at } };
  });
  const { user, router } = openPage('/settings');
  const wish = await screen.findByRole('switch', { name: /Show a notification/ });
  expect(shown).toEqual([]);
  const clock = Date.now;
  vi.spyOn(Date, 'now').mockImplementation(() => clock() + 600_000); // ten minutes after the page was opened
  await user.click(wish);
  await waitFor(() => expect(shown.map(({ body }) => body)).toEqual([NOTICE.message]));
  shown[0]?.onclick?.();
  await waitFor(() => expect(router.state.location.pathname).toBe('/runs/run-1'));
});

test('a thing is told of once, and of another occasion again', () => {
  const told = new Set<string>();
  expect(untold([NOTICE], told)).toEqual([NOTICE]);
  expect(untold([NOTICE, { ...NOTICE, occasion: '2' }], told)).toEqual([{ ...NOTICE, occasion: '2' }]);
});

test('whoever may change nothing is offered nothing, and asks for nothing that is refused', async () => {
  const caller = { name: 'vera', role: 'viewer', has_account: true };
  server.on('GET /api/auth/me', () => ({ body: { mode: 'accounts', caller, message: null } }));
  openPage('/settings');
  expect(await screen.findByText('3 GB would be removed')).toBeTruthy();
  expect(screen.getByText('Only an admin may change them.')).toBeTruthy();
  expect(screen.queryByRole('button', { name: 'Add' })).toBeNull();
  expect(screen.queryByRole('button', { name: 'Remove …' })).toBeNull();
  expect(server.asked.some((asked) => asked.path === '/api/webhooks')).toBe(false);
});
