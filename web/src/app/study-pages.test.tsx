import { act, screen, waitFor, within } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import { DONE, type FakeServer, problem } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { PREVIEW, STUDY, TEMPLATE } from '@/testing/samples';

const PATH = '/api/studies/study-1';
const OUTCOME = { study_id: 'study-1', queued: 1, joined: 0 };

let server: FakeServer;
beforeEach(() => {
  server = startServer()
    .on('GET /api/studies', () => ({ body: { studies: [STUDY] } }))
    .on(`GET ${PATH}`, () => ({ body: STUDY }))
    .on('POST /api/studies', () => ({ status: 201, body: OUTCOME }));
});

test('without studies, the page says what to do and offers two minutes', async () => {
  server.on('GET /api/studies', () => ({ body: { studies: [] } }));
  const { user, router } = openPage('/studies');
  expect(await screen.findByRole('link', { name: 'Choose what to compare' })).toBeTruthy();
  await user.click(await screen.findByRole('button', { name: 'Launch a two-minute study' }));
  await waitFor(() => expect(router.state.location.pathname).toBe('/studies/study-1'));
  expect(server.bodiesOf('POST', '/api/studies')).toEqual([
    { name: TEMPLATE.title, note: TEMPLATE.summary, spec: TEMPLATE.spec },
  ]);
});

test('a sample study that comes with the product is opened with one click', async () => {
  server.on('GET /api/studies', () => ({ body: { studies: [] } }));
  server.on('GET /api/study-files/sample', () => ({ body: { files: 1, size: 9_000_000 } }));
  server.on('POST /api/study-files/sample', () => ({ body: { studies: [imported('study-1')] } }));
  const { user, router } = openPage('/studies');
  await user.click(await screen.findByRole('button', { name: 'Open the sample study' }));
  await waitFor(() => expect(router.state.location.pathname).toBe('/studies/study-1'));
});

test('several sample studies are opened with one click too, and stand in the list', async () => {
  server.on('GET /api/study-files/sample', () => ({ body: { files: 2, size: 9_000_000 } }));
  server.on('POST /api/study-files/sample', () => ({ body: { studies: [imported('study-1'), imported('study-2')] } }));
  const { user, router } = openPage('/');
  await user.click(await screen.findByRole('button', { name: 'Open the sample studies' }));
  await waitFor(() => expect(router.state.location.pathname).toBe('/studies'));
});

test('beside studies of one’s own the samples can be opened too, and if they are there already, that is told', async () => {
  const there = { ...imported('study-2'), already_there: true };
  server.on('GET /api/study-files/sample', () => ({ body: { files: 1, size: 9_000_000 } }));
  server.on('POST /api/study-files/sample', () => ({ body: { studies: [there] } }));
  const { user, router } = openPage('/studies');
  await screen.findByRole('link', { name: 'Push' });
  await user.click(await screen.findByRole('button', { name: 'Open the sample study' }));
  expect(await screen.findByText('The sample study was here already.')).toBeTruthy();
  expect(router.state.location.pathname).toBe('/studies/study-2');
});

test('without runs, the runs page offers the same', async () => {
  server.on('POST /api/studies', () => problem(409, null, 'There is a study called so already.'));
  const { user } = openPage('/');
  await user.click(await screen.findByRole('button', { name: 'Launch a two-minute study' }));
  expect(await screen.findByText('There is a study called so already.')).toBeTruthy();
});

test('a row says what is compared and how far it is', async () => {
  openPage('/studies');
  const link = await screen.findByRole('link', { name: 'Push' });
  expect(link.getAttribute('href')).toBe('/studies/study-1');
  expect(screen.getByText('1 task × 2 methods × 2 seeds · preset quick')).toBeTruthy();
  expect(screen.getByRole('progressbar', { name: 'Progress of Push' }).getAttribute('aria-valuenow')).toBe('60');
});

test('the matrix shows the median, the states and the missing seeds of each cell', async () => {
  openPage('/studies/study-1');
  const her = await screen.findByRole('button', { name: /^FetchPush, her:/ });
  expect(within(her).getByText(/^80\s%$/)).toBeTruthy();
  expect(within(her).getByText('2 of 2')).toBeTruthy();
  const sldr = screen.getByRole('button', { name: /^FetchPush, her-sldr:/ });
  expect(within(sldr).getByText('missing: seed 1')).toBeTruthy();
  expect(within(sldr).getByTitle('1 failed')).toBeTruthy();
});

test('a cell opens its runs, and the address keeps it open', async () => {
  const { user, router } = openPage('/studies/study-1');
  await user.click(await screen.findByRole('button', { name: /^FetchPush, her-sldr:/ }));
  const runs = await screen.findByRole('region', { name: 'Runs of FetchPush, her-sldr' });
  expect(within(runs).getByRole('link', { name: 'Seed 0' }).getAttribute('href')).toBe('/runs/run-3');
  expect(within(runs).getByText('The loss became NaN.')).toBeTruthy();
  expect(router.state.location.search).toEqual({ task: 'FetchPush', method: 'her-sldr' });
});

test('what is missing is filled, what failed is tried again, and the page says what was done', async () => {
  server
    .on(`POST ${PATH}/fill`, () => ({ body: OUTCOME }))
    .on(`POST ${PATH}/retry`, () => ({
      body: { results: [{ run_id: 'run-3', done: true, message: 'It is queued.' }] },
    }));
  const { user } = openPage('/studies/study-1');
  await user.click(await screen.findByRole('button', { name: 'Fill 1 missing' }));
  expect(await screen.findByText('1 queued, 0 reused.')).toBeTruthy();
  await user.click(screen.getByRole('button', { name: 'Retry 1 failed' }));
  expect(await screen.findByText('1 of 1 are tried again.')).toBeTruthy();
  expect(server.bodiesOf('POST', `${PATH}/retry`)).toEqual([{ cancelled: false }]);
});

test('a deleted study can be had back at once', async () => {
  server.on(`DELETE ${PATH}`, () => DONE).on(`POST ${PATH}/restore`, () => DONE);
  const { user } = openPage('/studies/study-1');
  await user.click(await screen.findByRole('button', { name: 'Delete' }));
  await user.click(await screen.findByRole('button', { name: 'Undo' }));
  await waitFor(() => expect(server.bodiesOf('POST', `${PATH}/restore`)).toHaveLength(1));
});

test('an undo that is refused says why, wherever one is by then', async () => {
  server
    .on(`DELETE ${PATH}`, () => DONE)
    .on(`POST ${PATH}/restore`, () => problem(409, null, 'There is a study called so already.'));
  const { user, router } = openPage('/studies/study-1');
  await user.click(await screen.findByRole('button', { name: 'Delete' }));
  const undo = await screen.findByRole('button', { name: 'Undo' });
  await act(() => router.navigate({ to: '/studies' }));
  await user.click(undo);
  expect(await screen.findByText('There is a study called so already.')).toBeTruthy();
});

test('a study that cannot be restored from the list says why', async () => {
  const gone = { ...STUDY, deleted_at: STUDY.created_at };
  server
    .on('GET /api/studies', () => ({ body: { studies: [gone] } }))
    .on(`POST ${PATH}/restore`, () => problem(409, null, 'There is a study called so already.'));
  const { user } = openPage('/studies?deleted=yes');
  await user.click(await screen.findByRole('button', { name: 'Restore' }));
  expect(await screen.findByText('There is a study called so already.')).toBeTruthy();
});

test('a study without any success cannot be exported yet, and says so', async () => {
  server.on(`GET ${PATH}`, () => ({ body: { ...STUDY, states: { running: 3 } } }));
  openPage('/studies/study-1');
  const button = await screen.findByRole<HTMLButtonElement>('button', { name: 'Export' });
  expect(button.disabled).toBe(true);
  expect(button.title).toBe('It can be exported once a run has succeeded');
});

test('a study gets another name', async () => {
  server.on(`PATCH ${PATH}`, () => DONE);
  const { user } = openPage('/studies/study-1');
  await user.click(await screen.findByRole('button', { name: 'Edit' }));
  const name = await screen.findByRole('textbox', { name: 'Name' });
  await user.clear(name);
  await user.type(name, 'Better');
  await user.click(screen.getByRole('button', { name: 'Save' }));
  await waitFor(() => expect(server.bodiesOf('PATCH', PATH)).toEqual([{ name: 'Better', note: 'What it is for.' }]));
});

test('what was typed about a study stays when it is refused, and the reason is told beside it', async () => {
  server.on(`PATCH ${PATH}`, () => problem(409, 'name', 'There is a study called so already.'));
  const { user } = openPage('/studies/study-1');
  await user.click(await screen.findByRole('button', { name: 'Edit' }));
  const note = await screen.findByRole<HTMLTextAreaElement>('textbox', { name: 'Note' });
  await user.type(note, ' Long thoughts.');
  await user.click(screen.getByRole('button', { name: 'Save' }));
  const dialog = within(screen.getByRole('dialog', { name: 'Edit the study' }));
  expect(await dialog.findByText('There is a study called so already.')).toBeTruthy();
  expect(note.value).toBe('What it is for. Long thoughts.');
});

test('a study that does not exist gets one clear sentence', async () => {
  server.on('GET /api/studies/nope', () => problem(404, null, "There is no study 'nope'."));
  openPage('/studies/nope');
  expect(await screen.findByText("There is no study 'nope'.")).toBeTruthy();
});

function imported(study_id: string) {
  return { study_id, runs: 40, already_there: false };
}

/** The button that adds, once it may be pressed. */
async function addButton(dialog: HTMLElement): Promise<HTMLElement> {
  const button = within(dialog).getByRole<HTMLButtonElement>('button', { name: 'Add and queue' });
  await waitFor(() => expect(button.disabled).toBe(false));
  return button;
}

test('nothing is added before it was said what that would queue', async () => {
  server.on('POST /api/studies/preview', () => new Promise(() => {}));
  const { user } = openPage('/studies/study-1');
  await user.click(await screen.findByRole('button', { name: 'Add seeds …' }));
  const button = await screen.findByRole<HTMLButtonElement>('button', { name: 'Add and queue' });
  expect(button.disabled).toBe(true);
});

test('what was to be added stays when it is refused', async () => {
  server
    .on('POST /api/studies/preview', () => ({ body: PREVIEW }))
    .on(`POST ${PATH}/extend`, () => problem(409, null, 'The study was deleted.'));
  const { user } = openPage('/studies/study-1');
  await user.click(await screen.findByRole('button', { name: 'Add seeds …' }));
  const dialog = await screen.findByRole('dialog', { name: 'Add to the study' });
  await user.type(within(dialog).getByRole('textbox', { name: 'Seeds' }), ', 7');
  await user.click(await addButton(dialog));
  expect(await within(dialog).findByText('The study was deleted.')).toBeTruthy();
  expect(within(dialog).getByRole<HTMLInputElement>('textbox', { name: 'Seeds' }).value).toBe('2, 7');
});

test('seeds are added, and what that would queue is said before', async () => {
  server
    .on('POST /api/studies/preview', () => ({ body: PREVIEW }))
    .on(`POST ${PATH}/extend`, () => ({ body: OUTCOME }));
  const { user } = openPage('/studies/study-1');
  await user.click(await screen.findByRole('button', { name: 'Add seeds …' }));
  const dialog = await screen.findByRole('dialog', { name: 'Add to the study' });
  expect(await within(dialog).findByText(/will be queued/)).toBeTruthy();
  expect(within(dialog).queryByText('Variants')).toBeNull();
  await user.click(await addButton(dialog));
  await waitFor(() => expect(server.bodiesOf('POST', `${PATH}/extend`)).toHaveLength(1));
  const [addition] = server.bodiesOf('POST', `${PATH}/extend`);
  expect(addition).toEqual({ seeds: [2], tasks: [], methods: [], variants: [] });
});

test('a study that varies a setting gets another value of it', async () => {
  const variants = [{ name: 'gamma=0.95', overrides: { agent: { gamma: 0.95 } } }];
  server
    .on(`GET ${PATH}`, () => ({ body: { ...STUDY, spec: { ...STUDY.spec, variants } } }))
    .on('POST /api/studies/preview', () => ({ body: PREVIEW }))
    .on(`POST ${PATH}/extend`, () => ({ body: OUTCOME }));
  const { user } = openPage('/studies/study-1');
  await user.click(await screen.findByRole('button', { name: 'Add seeds …' }));
  const dialog = await screen.findByRole('dialog', { name: 'Add to the study' });
  await user.clear(within(dialog).getByRole('textbox', { name: 'Seeds' }));
  await user.type(await within(dialog).findByRole('textbox', { name: 'Values of agent.gamma' }), '0.98');
  const added = { name: 'gamma=0.98', overrides: { agent: { gamma: 0.98 } } };
  const spec = { ...STUDY.spec, variants: [...variants, added] };
  await waitFor(() =>
    expect(server.bodiesOf('POST', '/api/studies/preview').at(-1)).toEqual({ spec, study_id: 'study-1' }),
  );
  await user.click(await addButton(dialog));
  await waitFor(() =>
    expect(server.bodiesOf('POST', `${PATH}/extend`)).toEqual([
      { seeds: [], tasks: [], methods: [], variants: [added] },
    ]),
  );
});
