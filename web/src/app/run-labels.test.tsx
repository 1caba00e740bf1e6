import { screen, waitFor } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import { NO_METRICS } from '@/lib/metrics';
import { DONE, type FakeServer } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { DETAIL } from '@/testing/samples';

let server: FakeServer;
const tagged = (...tags: string[]): FakeServer =>
  server.on('GET /api/runs/run-1', () => ({ body: { ...DETAIL, tags } }));
beforeEach(() => {
  server = startServer()
    .on('GET /api/runs/run-1/metrics', () => ({ body: NO_METRICS }))
    .on('POST /api/runs/tags', () => DONE);
});

const reads = (): number => server.asked.filter(({ path }) => path === '/api/runs/run-1').length;

test('tags that others give while one edits stay', async () => {
  tagged('mine');
  const { user } = openPage('/runs/run-1?tab=config');
  await user.click(await screen.findByRole('button', { name: 'Edit tags' }));
  tagged('mine', 'theirs');
  const before = reads();
  await waitFor(() => expect(reads()).toBeGreaterThan(before + 1));
  await user.type(screen.getByLabelText('Tags', { selector: 'input' }), 'new{Enter}');
  await user.click(screen.getByRole('button', { name: 'Save' }));
  await waitFor(() =>
    expect(server.bodiesOf('POST', '/api/runs/tags')).toEqual([{ run_ids: ['run-1'], add: ['new'], remove: [] }]),
  );
});

test.each([
  ['Add tags', 'Tags'],
  ['Add notes', 'Notes, as plain text'],
])('%s leads into the field, and back to the button', async (name, field) => {
  tagged();
  const { user } = openPage('/runs/run-1?tab=config');
  await user.click(await screen.findByRole('button', { name }));
  expect(document.activeElement).toBe(screen.getByLabelText(field, { selector: 'input, textarea' }));
  await user.click(screen.getByRole('button', { name: 'Keep as it was' }));
  expect(document.activeElement).toBe(screen.getByRole('button', { name }));
});
