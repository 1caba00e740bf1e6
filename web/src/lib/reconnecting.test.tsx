import { screen } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import { Refused, Unreachable, unwrap } from '@/lib/api';
import type { FakeServer } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { PREVIEW } from '@/testing/samples';
import { RECONNECT_MS, reconnecting } from './reconnecting';

let server: FakeServer;
beforeEach(() => {
  server = startServer()
    .on('POST /api/studies/preview', () => ({ body: PREVIEW }))
    .on('GET /api/webhooks', () => ({ body: { webhooks: [] } }))
    .on('GET /api/accounts', () => ({ body: { accounts: [] } }))
    .on('GET /api/audit', () => ({ body: { entries: [], next: null } }));
  server.isDown = true;
});

test.each([
  ['/studies/new', 'The choices cannot be shown', 'Name'],
  ['/settings', 'The other settings cannot be shown', 'Address'],
  ['/accounts', 'The accounts cannot be shown', 'Name of the new account'],
])('%s says that the server does not answer, and is whole by itself once it does', async (address, title, field) => {
  openPage(address);
  const heading = await screen.findByRole('heading', { name: title });
  expect(heading.parentElement?.textContent).toContain('The server does not answer.');
  server.isDown = false;
  expect(await screen.findByLabelText(new RegExp(`^${field}`))).toBeTruthy();
  expect(screen.queryByRole('heading', { name: title })).toBeNull();
});

test('what the server has refused is not asked for again', () => {
  expect(reconnecting({ state: { error: new Unreachable(null) } })).toBe(RECONNECT_MS);
  expect(reconnecting({ state: { error: new Refused(403, []) } })).toBe(false);
  expect(reconnecting({ state: { error: null } })).toBe(false);
});

test.each([
  [502, '<html>Bad Gateway</html>', Unreachable],
  [503, { problems: [{ field: null, message: 'The store cannot be used just now.' }] }, Refused],
  [500, 'Internal Server Error', Refused],
])('an answer with status %i comes from a proxy or from the server itself', async (status, error, kind) => {
  const answer = { error, response: new Response(null, { status }) };
  await expect(unwrap(Promise.resolve(answer))).rejects.toBeInstanceOf(kind);
});
