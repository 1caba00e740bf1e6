import { screen, waitFor, within } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import type { RunDetail } from '@/client/schema.gen';
import { NO_METRICS } from '@/lib/metrics';
import type { FakeServer } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { DETAIL, RUN } from '@/testing/samples';

let server: FakeServer;
beforeEach(() => {
  server = startServer()
    .on('GET /api/runs/run-1/metrics', () => ({ body: NO_METRICS }))
    .on('POST /api/runs/actions', ({ body }) => ({ body: { results: doneFor(body as { run_ids: string[] }) } }));
});

function doneFor({ run_ids }: { run_ids: string[] }) {
  return run_ids.map((run_id) => ({ run_id, done: true, message: `Run ${run_id} is done with.` }));
}

function openRun(changes: Partial<RunDetail>, tab = '') {
  server.on('GET /api/runs/run-1', () => ({ body: { ...DETAIL, ...changes } }));
  return openPage(`/runs/run-1${tab}`);
}

const sent = (): unknown[] => server.bodiesOf('POST', '/api/runs/actions');

test('the config tab marks what differs from the preset', async () => {
  openRun({}, '?tab=config');
  expect(await screen.findByText(/1 setting changed from the preset quick/)).toBeTruthy();
  expect(screen.getByText('0.99')).toBeTruthy();
});

test('the overview says what differs', async () => {
  openRun({});
  const panel = within(await screen.findByRole('region', { name: 'What differs' }));
  expect(panel.getByText('Gamma').nextElementSibling?.textContent).toBe('0.99 was 0.98');
});

test('launching again names the run', async () => {
  openRun({}, '?tab=config');
  const link = await screen.findByRole('link', { name: 'Launch again' });
  expect(link.getAttribute('href')).toBe(
    '/launch?task=FetchPush&phase=manipulation&method=her-sldr&preset=quick&seeds=0&from=run-1',
  );
});

test.each([
  ['paused', 'The run is held before its first cycle', 'No curves yet'],
  ['succeeded', 'Its model came with the product; it was not trained here.', 'No curves'],
  ['failed', 'The run ended before its first cycle.', 'No curves'],
] as const)('a run without curves that is %s says why', async (state, why, title) => {
  openRun({ state, started_at: null });
  expect(await screen.findByText(why, { exact: false })).toBeTruthy();
  expect(screen.getByRole('heading', { name: title })).toBeTruthy();
});

test('paused is said of a run that was held as of one that saved a checkpoint', async () => {
  const { user } = openRun({ state: 'paused', started_at: null }, '?tab=config');
  await user.hover(await screen.findByText('paused'));
  expect((await screen.findByRole('tooltip')).textContent).toBe('Held until a person resumes it.');
});

/** Take the clipboard away; return what is copied without it, which the browser may refuse too. */
function withoutClipboard(isAllowed: boolean): string[] {
  const copied: string[] = [];
  Object.defineProperty(navigator, 'clipboard', { configurable: true, value: undefined });
  document.execCommand = () => {
    if (isAllowed) copied.push((document.activeElement as HTMLTextAreaElement).value);
    return isAllowed;
  };
  return copied;
}

test('over plain http a text is copied all the same', async () => {
  const { user } = openRun({}, '?tab=config');
  const copied = withoutClipboard(true);
  await user.click(await screen.findByRole('button', { name: 'Copy as JSON' }));
  expect(await screen.findByRole('button', { name: 'Copied' })).toBe(document.activeElement);
  expect(copied).toEqual([JSON.stringify(DETAIL.config, null, 2)]);
  expect(document.querySelector('body > textarea')).toBeNull();
});

test('a text that cannot be copied is to be selected by hand', async () => {
  const { user } = openRun({}, '?tab=config');
  withoutClipboard(false);
  await user.click(await screen.findByRole('button', { name: 'Copy as JSON' }));
  expect(await screen.findByText(/Select the text and copy it by hand/)).toBeTruthy();
  expect(screen.queryByRole('button', { name: 'Copied' })).toBeNull();
});

test('cancelling what runs asks first, then tells the server', async () => {
  const { user } = openRun({}, '?tab=config');
  await user.click(await screen.findByRole('button', { name: 'Actions' }));
  await user.click(await screen.findByRole('menuitem', { name: /^Cancel/ }));
  expect(sent()).toEqual([]);
  await user.click(await screen.findByRole('button', { name: 'Yes, cancel it' }));
  expect(await screen.findByText('Run run-1 is done with.')).toBeTruthy();
  expect(sent()).toEqual([{ action: 'cancel', run_ids: ['run-1'] }]);
});

test('pausing loses nothing, so it asks nothing', async () => {
  const { user } = openRun({}, '?tab=config');
  await user.click(await screen.findByRole('button', { name: 'Pause' }));
  expect(await screen.findByText('Run run-1 is done with.')).toBeTruthy();
  expect(sent()).toEqual([{ action: 'pause', run_ids: ['run-1'] }]);
});

test('a run that has been asked to pause says so until it has', async () => {
  openRun({ pause_requested: true }, '?tab=config');
  expect(await screen.findByText('pausing')).toBeTruthy();
});

test('deleting leads to the list, where it can be undone', async () => {
  const { user, router } = openRun({ state: 'failed' }, '?tab=config');
  await user.click(await screen.findByRole('button', { name: 'Actions' }));
  await user.click(await screen.findByRole('menuitem', { name: /^Delete/ }));
  await user.click(await screen.findByRole('button', { name: 'Undo' }));
  expect(router.state.location.pathname).toBe('/');
  await waitFor(() =>
    expect(sent()).toEqual([
      { action: 'delete', run_ids: ['run-1'] },
      { action: 'restore', run_ids: ['run-1'] },
    ]),
  );
});

test('a deleted run can be restored on its own page', async () => {
  openRun({ state: 'failed', deleted_at: '2026-01-01T10:00:00Z' }, '?tab=config');
  expect(await screen.findByRole('button', { name: 'Restore' })).toBeTruthy();
  expect(screen.getByText(/stands in no list/)).toBeTruthy();
});

test('a run below its gate says why and can be released', async () => {
  const reason = 'Its locomotion run run-0 reached 80.0% test success, below the gate of 95.0%.';
  const progress = { ...RUN.progress, success_rate: 0.947 };
  server.on('GET /api/runs/run-0', () => ({ body: { ...DETAIL, id: 'run-0', state: 'succeeded', progress } }));
  const { user } = openRun({ state: 'blocked', is_below_gate: true, reason, needs: ['run-0'] });
  const panel = (await screen.findByText('The object has not learnt well enough')).closest('section');
  if (panel === null) throw new Error('The title stands in no panel.');
  expect(within(panel).getByText(/That is why the run waits/)).toBeTruthy();
  expect(await within(panel).findByText(/^test success 94\.7\s%$/)).toBeTruthy();
  expect(screen.getByText(/reached 80.0% test success, below the gate of 95.0%/)).toBeTruthy();
  await user.click(within(panel).getByRole('button', { name: 'Release anyway' }));
  await waitFor(() => expect(sent()).toEqual([{ action: 'release', run_ids: ['run-1'] }]));
});

test('a run that needs two locomotion runs shows both, and leads to the one that holds it back', async () => {
  const needed = { ...DETAIL, phase: 'locomotion' as const };
  server
    .on('GET /api/runs/run-8', () => ({ body: { ...needed, id: 'run-8', task: 'HandEggTranslate' } }))
    .on('GET /api/runs/run-9', () => ({ body: { ...needed, id: 'run-9', task: 'HandEggRotate' } }));
  openRun({ state: 'blocked', reason: 'Waits for the locomotion run run-9.', needs: ['run-8', 'run-9'] });
  const first = await screen.findByRole('link', { name: 'HandEggTranslate' });
  expect(first.getAttribute('href')).toBe('/runs/run-8');
  expect((await screen.findByRole('link', { name: 'HandEggRotate' })).getAttribute('href')).toBe('/runs/run-9');
  expect(screen.getByRole('link', { name: 'Watch the locomotion run' }).getAttribute('href')).toBe('/runs/run-9');
});

test('a run says which locomotion runs it learns from', async () => {
  openRun({ needs: ['run-8', 'run-9'] }, '?tab=config');
  const link = await screen.findByRole('link', { name: 'its locomotion run run-9' });
  expect(link.getAttribute('href')).toBe('/runs/run-9');
  expect(screen.getByRole('link', { name: 'its locomotion run run-8' })).toBeTruthy();
});

test('the history shows where each attempt trained and how it ended', async () => {
  server
    .on('GET /api/runs/run-1/events', () => ({ body: { events: [] } }))
    .on('GET /api/runs/run-1/attempts', () => ({
      body: {
        attempts: [
          {
            attempt: 1,
            worker_id: 'w1',
            host: 'box-3',
            started_at: '2026-01-01T10:00:00Z',
            ended_at: '2026-01-01T10:02:00Z',
            outcome: 'lost',
            reason: 'Its worker gave no sign of life.',
            first_cycle: 1,
          },
        ],
      },
    }));
  openRun({}, '?tab=history');
  const table = within(await screen.findByRole('table', { name: 'Attempts' }));
  for (const text of ['box-3', 'Lost', '2m', 'Its worker gave no sign of life.']) {
    expect(table.getByText(text)).toBeTruthy();
  }
});
