/** Open the whole page at an address, in front of a fake server. */
import { createMemoryHistory } from '@tanstack/react-router';
import { render } from '@testing-library/react';
import userEvent from '@testing-library/user-event';
import { App } from '@/app/app';
import { makeRouter } from '@/app/router';
import { FakeServer } from '@/testing/fake-server';
import { CHOICES, DEFAULTS, TEMPLATE } from '@/testing/samples';

/** Whoever came with the token of a server on loopback. */
const LOCAL = { name: 'local', role: 'admin', has_account: false };

/** A server that knows the choices, one living worker, and no runs. */
export function startServer(): FakeServer {
  return new FakeServer()
    .on('GET /healthz', () => ({ body: { status: 'ok', version: '0', workers_alive: 1, viewer_alive: true } }))
    .on('GET /api/auth/me', () => ({ body: { mode: 'token', caller: LOCAL, message: null } }))
    .on('GET /api/choices', () => ({ body: CHOICES }))
    .on('GET /api/defaults', () => ({ body: DEFAULTS }))
    .on('GET /api/study-files/sample', () => ({ body: { files: 0, size: 0 } }))
    .on('GET /api/studies/templates', () => ({ body: { templates: [TEMPLATE] } }))
    .on('GET /api/runs', () => ({ body: { runs: [], values: [], next_cursor: null, total: 0 } }))
    .on('GET /api/tags', () => ({ body: { tags: [] } }))
    .on('GET /api/views', () => ({ body: { views: [] } }))
    .on('GET /api/metric-names', () => ({ body: { names: [] } }))
    .start();
}

export function openPage(address: string) {
  const router = makeRouter(createMemoryHistory({ initialEntries: [address] }));
  render(<App router={router} />);
  return { router, user: userEvent.setup() };
}
