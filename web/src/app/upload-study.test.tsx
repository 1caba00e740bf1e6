import { act, fireEvent, screen, waitFor } from '@testing-library/react';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import type { FakeServer } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { STUDY } from '@/testing/samples';

/** The way out of the browser, held by the test. */
class HeldRequest {
  static last: HeldRequest;
  readonly upload: { onprogress?: (event: { loaded: number; total: number }) => void } = {};
  readonly headers: Record<string, string> = {};
  status = 0;
  response: unknown = null;
  onload?: () => void;
  onerror?: () => void;
  sent: File | undefined;
  address = '';

  constructor() {
    HeldRequest.last = this;
  }
  open(method: string, address: string): void {
    this.address = `${method} ${address}`;
  }
  setRequestHeader(name: string, value: string): void {
    this.headers[name] = value;
  }
  send(file: File): void {
    this.sent = file;
  }
  answer(status: number, response: unknown): void {
    this.status = status;
    this.response = response;
    act(() => this.onload?.());
  }
}

let server: FakeServer;
beforeEach(() => {
  vi.stubGlobal('XMLHttpRequest', HeldRequest);
  server = startServer().on('GET /api/studies', () => ({ body: { studies: [STUDY] } }));
});
afterEach(() => {
  vi.unstubAllGlobals();
});

async function choose(file: File): Promise<void> {
  await screen.findByRole('button', { name: 'Upload a study file' });
  fireEvent.change(screen.getByLabelText('Study file'), { target: { files: [file] } });
}

test('a study file is sent as it is, its progress is shown, and the study opens', async () => {
  server.on('GET /api/studies/study-1', () => ({ body: STUDY }));
  const { router } = openPage('/studies');
  const file = new File(['PK'], 'study.zip');
  await choose(file);
  await screen.findByText(/^Sending, 0/);
  const request = HeldRequest.last;
  expect([request.address, request.sent, request.headers['Content-Type']]).toEqual([
    'POST /api/study-files',
    file,
    'application/zip',
  ]);
  act(() => request.upload.onprogress?.({ loaded: 1, total: 4 }));
  expect(screen.getByRole('progressbar', { name: 'Sent of the study file' }).getAttribute('aria-valuenow')).toBe('25');
  act(() => request.upload.onprogress?.({ loaded: 4, total: 4 }));
  expect(screen.getByText('The server looks at it')).toBeTruthy();
  request.answer(200, { study_id: 'study-1', runs: 6, already_there: false });
  await waitFor(() => expect(router.state.location.pathname).toBe('/studies/study-1'));
  expect(screen.getByText('A study with 6 runs is here.')).toBeTruthy();
});

test('a file that is refused gets the server’s sentence, and the button is back', async () => {
  openPage('/studies');
  await choose(new File(['no'], 'holiday.zip'));
  await screen.findByText(/^Sending/);
  const message = 'The uploaded file is no study file: it is not a zip archive.';
  HeldRequest.last.answer(422, { problems: [{ field: null, message }] });
  expect(await screen.findByText(message)).toBeTruthy();
  expect(screen.getByRole('button', { name: 'Upload a study file' })).toBeTruthy();
});

test('who has left meanwhile is told what became of a file, and stays', async () => {
  const { router } = openPage('/studies');
  const message = 'The uploaded file is no study file: it is not a zip archive.';
  for (const [status, answer, told] of [
    [422, { problems: [{ field: null, message }] }, message],
    [200, { study_id: 'study-1', runs: 6, already_there: false }, 'A study with 6 runs is here.'],
  ] as const) {
    await act(() => router.navigate({ to: '/studies' }));
    await choose(new File(['PK'], 'study.zip'));
    await screen.findByText(/^Sending/);
    await act(() => router.navigate({ to: '/compare/configs' }));
    HeldRequest.last.answer(status, answer);
    expect(await screen.findByText(told)).toBeTruthy();
    expect(router.state.location.pathname).toBe('/compare/configs');
  }
});

test('a connection that breaks is told as such', async () => {
  openPage('/studies');
  await choose(new File(['PK'], 'study.zip'));
  await screen.findByText(/^Sending/);
  act(() => HeldRequest.last.onerror?.());
  expect(await screen.findByText(/The server does not answer/)).toBeTruthy();
});

test('a file that is too large is not sent at all', async () => {
  openPage('/studies');
  const file = new File(['PK'], 'huge.zip');
  Object.defineProperty(file, 'size', { value: 513 * 2 ** 20 });
  await choose(file);
  expect(await screen.findByText('huge.zip has 513 MB; a study file has 512 MB at most.')).toBeTruthy();
});
