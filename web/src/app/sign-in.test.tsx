import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import { DONE, type FakeServer, problem } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';

let server: FakeServer;
beforeEach(() => {
  server = startServer();
});

function askFor(mode: 'token' | 'accounts', message = 'Your session has ended; sign in again.') {
  server.on('GET /api/auth/me', () => ({ body: { mode, caller: null, message } }));
}

test('whoever is not known is led to sign in, with a sentence, and back afterwards', async () => {
  askFor('accounts');
  server.on('GET /api/workers', () => problem(401, null, 'Your session has ended; sign in again.'));
  server.on('POST /api/auth/sign-in', () => {
    const caller = { name: 'ada', role: 'operator', has_account: true };
    server.on('GET /api/auth/me', () => ({ body: { mode: 'accounts', caller, message: null } }));
    server.on('GET /api/workers', () => ({ body: { workers: [] } }));
    return DONE;
  });
  const { router, user } = openPage('/workers');
  await screen.findByLabelText(/^Name/);
  expect(screen.getByText('Your session has ended; sign in again.')).toBeTruthy();
  expect(router.state.location.pathname).toBe('/sign-in');
  expect(screen.queryByRole('navigation')).toBeNull();
  await user.type(screen.getByLabelText(/^Name/), 'ada');
  await user.type(screen.getByLabelText(/^Password/), 'seven purple otters');
  await user.click(screen.getByRole('button', { name: 'Sign in' }));
  await waitFor(() => expect(router.state.location.pathname).toBe('/workers'));
  expect(server.bodiesOf('POST', '/api/auth/sign-in')).toEqual([{ name: 'ada', password: 'seven purple otters' }]);
});

test.each(['/account', '/accounts', '/settings'])(
  '%s, which shows strangers nothing, leads them in',
  async (address) => {
    askFor('accounts');
    const { router } = openPage(address);
    expect(await screen.findByLabelText(/^Password/)).toBeTruthy();
    expect(router.state.location.href).toBe(`/sign-in?from=${encodeURIComponent(address)}`);
  },
);

test('whoever was signed in until now can sign in again', async () => {
  const caller = { name: 'ada', role: 'operator', has_account: true };
  server.on('GET /api/auth/me', () => ({ body: { mode: 'accounts', caller, message: null } }));
  server.on('GET /api/workers', () => {
    askFor('accounts');
    return problem(401, null, 'Your session has ended; sign in again.');
  });
  openPage('/workers');
  expect(await screen.findByLabelText(/^Password/)).toBeTruthy();
  expect(screen.queryByText('You are signed in as ada.')).toBeNull();
});

test('a server on this machine asks for its token', async () => {
  askFor('token');
  server.on('POST /api/auth/enter', () => problem(403, 'token', 'This is not the token of this server.'));
  const { user } = openPage('/sign-in?reason=token');
  await user.type(await screen.findByLabelText(/^Token/), ' sldr_wrong ');
  await user.click(screen.getByRole('button', { name: 'Sign in' }));
  expect(await screen.findByText('This is not the token of this server.')).toBeTruthy();
  expect(server.bodiesOf('POST', '/api/auth/enter')).toEqual([{ token: 'sldr_wrong' }]);
});

test('a one-time link sets a password and leaves the address', async () => {
  server.on('POST /api/auth/invitation', () => ({ body: { name: 'ada', role: 'operator' } }));
  server.on('POST /api/auth/invitation/accept', () => DONE);
  const { router, user } = openPage('/welcome#sldr_link');
  await screen.findByRole('heading', { name: 'Welcome, ada' });
  expect(router.state.location.href).toBe('/welcome');
  await user.type(screen.getByLabelText(/^Password/), 'seven purple otters');
  await user.type(screen.getByLabelText(/^Once more/), 'seven purple otters');
  await user.click(screen.getByRole('button', { name: 'Set it and sign in' }));
  await waitFor(() => expect(router.state.location.pathname).toBe('/'));
  const sent = { token: 'sldr_link', password: 'seven purple otters' };
  expect(server.bodiesOf('POST', '/api/auth/invitation/accept')).toEqual([sent]);
});

test('another one-time link that is opened in the same tab is used', async () => {
  server.on('POST /api/auth/invitation', ({ body }) =>
    (body as { token: string }).token === 'old'
      ? problem(409, null, 'This link was used already.')
      : { body: { name: 'ada', role: 'operator' } },
  );
  const { router } = openPage('/welcome#old');
  await screen.findByText('This link was used already.');
  act(() => router.history.push('/welcome#new'));
  expect(await screen.findByRole('heading', { name: 'Welcome, ada' })).toBeTruthy();
  expect(router.state.location.href).toBe('/welcome');
});

test('a link that was used says so', async () => {
  server.on('POST /api/auth/invitation', () => problem(409, null, 'This link was used already.'));
  openPage('/welcome');
  expect(await screen.findByText('This link was used already.')).toBeTruthy();
});
