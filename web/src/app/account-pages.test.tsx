import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import { DONE, type FakeServer, problem } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';

const AT = '2026-01-01T10:00:00Z';
const TOKEN = { id: 't1', name: 'notebook', role: 'viewer', created_at: AT, expires_at: null, used_at: null };
const ACCOUNT = { id: 'a1', name: 'ada', role: 'operator', has_password: true, created_at: AT, disabled_at: null };
const SESSION = { id: 's1', created_at: AT, seen_at: AT, expires_at: AT, address: '10.0.0.7', is_this: true };

let server: FakeServer;
beforeEach(() => {
  server = startServer()
    .on('GET /api/account/sessions', () => ({ body: { sessions: [{ ...SESSION, agent: 'X Firefox/140.0' }] } }))
    .on('GET /api/account/tokens', () => ({ body: { tokens: [TOKEN] } }))
    .on('GET /api/accounts', () => ({ body: { accounts: [ACCOUNT] } }))
    .on('GET /api/audit', () => ({ body: { entries: [], next: null } }));
});

function be(role: string) {
  const caller = { name: 'ada', role, has_account: true };
  server.on('GET /api/auth/me', () => ({ body: { mode: 'accounts', caller, message: null } }));
}

test('the account page shows where one is signed in, and ends a session', async () => {
  be('viewer');
  server.on('DELETE /api/account/sessions/s1', () => DONE);
  const { user } = openPage('/account');
  expect(await screen.findByText('Firefox 140, this one')).toBeTruthy();
  await user.click(screen.getByRole('button', { name: 'End the session of Firefox 140 at 10.0.0.7' }));
  await waitFor(() => expect(server.bodiesOf('DELETE', '/api/account/sessions/s1')).toHaveLength(1));
});

test('a token is made with a role of one’s own at most, and its secret is shown', async () => {
  be('operator');
  server.on('POST /api/account/tokens', () => ({ status: 201, body: { token: TOKEN, secret: 'sldr_once' } }));
  const { user } = openPage('/account');
  await user.type(await screen.findByLabelText(/^What it is for/), 'notebook');
  expect([...screen.getByLabelText('Role').children].map((option) => option.textContent)).toEqual([
    'viewer',
    'operator',
  ]);
  await user.click(screen.getByRole('button', { name: 'Make a token' }));
  expect(await screen.findByText('sldr_once')).toBeTruthy();
  expect(server.bodiesOf('POST', '/api/account/tokens')).toEqual([{ name: 'notebook', role: 'viewer', days: 90 }]);
});

test('an admin makes an account and gets its one-time link', async () => {
  be('admin');
  const body = { account: { ...ACCOUNT, name: 'bob' }, path: '/welcome#sldr_link', expires_at: AT };
  server.on('POST /api/accounts', () => ({ status: 201, body }));
  const { user } = openPage('/accounts');
  await user.type(await screen.findByLabelText(/^Name of the new account/), 'Bob');
  await user.click(screen.getByRole('button', { name: 'Add and make its link' }));
  expect(await screen.findByText(/\/welcome#sldr_link$/)).toBeTruthy();
  expect(server.bodiesOf('POST', '/api/accounts')).toEqual([{ name: 'bob', role: 'operator' }]);
});

test('an admin closes an account', async () => {
  be('admin');
  server.on('PATCH /api/accounts/a1', () => ({ body: ACCOUNT }));
  const { user } = openPage('/accounts');
  await user.click(await screen.findByRole('button', { name: 'Close' }));
  await waitFor(() => expect(server.bodiesOf('PATCH', '/api/accounts/a1')).toEqual([{ disabled: true }]));
});

test('the audit log shows all that was asked for, however long it is', async () => {
  be('admin');
  const entries = Array.from({ length: 501 }, (_, id) => {
    return { id, at: AT, who: `who-${id}`, action: 'a', address: 'x', outcome: 'done', target: 't', detail: 'd' };
  });
  server.on('GET /api/audit', () => ({ body: { entries, next: null } }));
  openPage('/accounts');
  const isTold = (text: string): boolean | undefined => document.body.textContent?.includes(text);
  await waitFor(() => expect(isTold('who-500')).toBe(true));
  expect(isTold('CSV')).toBe(false);
});

test('others are told that accounts are for admins', async () => {
  be('operator');
  openPage('/accounts');
  expect(await screen.findByText('Only admins see this')).toBeTruthy();
});

test('the name of an account or a token that was refused stays, and goes once it is accepted', async () => {
  be('admin');
  const refuse = () => problem(409, 'name', 'There is one called so already.');
  server.on('POST /api/accounts', refuse).on('POST /api/account/tokens', refuse);
  const { user, router } = openPage('/accounts');
  const name = await screen.findByLabelText<HTMLInputElement>(/^Name of the new account/);
  await user.type(name, 'bob{Enter}');
  expect(await screen.findByText('There is one called so already.')).toBeTruthy();
  expect(name.value).toBe('bob');
  const link = { account: { ...ACCOUNT, name: 'bob' }, path: '/welcome#sldr_link', expires_at: AT };
  server.on('POST /api/accounts', () => ({ status: 201, body: link }));
  await user.type(name, '{Enter}');
  await waitFor(() => expect(name.value).toBe(''));

  await act(() => router.navigate({ to: '/account' }));
  const purpose = await screen.findByLabelText<HTMLInputElement>(/^What it is for/);
  await user.type(purpose, 'notebook{Enter}');
  expect(await screen.findByText('There is one called so already.')).toBeTruthy();
  expect(purpose.value).toBe('notebook');
  server.on('POST /api/account/tokens', () => ({ status: 201, body: { token: TOKEN, secret: 'sldr_once' } }));
  await user.type(purpose, '{Enter}');
  await waitFor(() => expect(purpose.value).toBe(''));
});
