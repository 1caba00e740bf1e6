import { QueryClient, QueryClientProvider } from '@tanstack/react-query';
import { act, renderHook, waitFor } from '@testing-library/react';
import type { ReactNode } from 'react';
import { beforeEach, expect, test } from 'vitest';
import { DONE, FakeServer, problem } from '@/testing/fake-server';
import { useViewerSession } from './viewer-session';

const PATH = '/api/viewer-sessions/s';
const SESSION = { id: 's', run_id: 'run-1', state: 'starting', url: null, message: null };

let server: FakeServer;
beforeEach(() => {
  server = new FakeServer()
    .on('POST /api/viewer-sessions', () => ({ status: 201, body: SESSION }))
    .on(`GET ${PATH}`, () => ({ body: SESSION }))
    .on(`DELETE ${PATH}`, () => DONE)
    .start();
});

const polls = (): number => server.asked.filter(({ method, path }) => method === 'GET' && path === PATH).length;

async function opened() {
  const queries = new QueryClient({ defaultOptions: { queries: { retry: false } } });
  const wrapper = ({ children }: { children: ReactNode }) => (
    <QueryClientProvider client={queries}>{children}</QueryClientProvider>
  );
  const { result } = renderHook(() => useViewerSession(), { wrapper });
  act(() => result.current.open({ run_id: 'run-1' } as Parameters<typeof result.current.open>[0]));
  await waitFor(() => expect(polls()).toBeGreaterThan(0));
  await waitFor(() => expect(result.current.session).toEqual(SESSION));
  return result;
}

test('a session that the server cannot be asked for once stays as it was', async () => {
  const result = await opened();
  server.on(`GET ${PATH}`, () => problem(503, null, 'The store cannot be used just now.'));
  const before = polls();
  await waitFor(() => expect(polls()).toBeGreaterThan(before + 1));
  expect(result.current.error).toBeNull();
  expect(result.current.session).toEqual(SESSION);
});

test('a session that is no more says so', async () => {
  const result = await opened();
  server.on(`GET ${PATH}`, () => problem(404, null, 'There is no session s.'));
  await waitFor(() => expect(result.current.error).not.toBeNull());
});
