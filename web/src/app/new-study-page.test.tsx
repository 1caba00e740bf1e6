import { act, screen, waitFor, within } from '@testing-library/react';
import { beforeEach, expect, test } from 'vitest';
import { type FakeServer, problem } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { PREVIEW, STUDY } from '@/testing/samples';

let server: FakeServer;
beforeEach(() => {
  server = startServer()
    .on('POST /api/studies/preview', () => ({ body: PREVIEW }))
    .on('POST /api/studies', () => ({ status: 201, body: { study_id: 'study-1', queued: 4, joined: 1 } }))
    .on('GET /api/studies/study-1', () => ({ body: STUDY }));
});

function lastSpec(): unknown {
  return (server.bodiesOf('POST', '/api/studies/preview').at(-1) as { spec: unknown } | undefined)?.spec;
}

test('the preview shows every run as a matrix, the locomotion runs, time and disk', async () => {
  openPage('/studies/new');
  const matrix = await screen.findByRole('region', { name: 'What will run' });
  expect(within(matrix).getByText(/1\s+reused/)).toBeTruthy();
  expect(within(matrix).getByText(/2\s+new/)).toBeTruthy();
  const panel = screen.getByRole('complementary', { name: 'What will be queued' });
  expect(within(panel).getByText(/Locomotion: 1 added, trained first/)).toBeTruthy();
  expect(within(panel).getByText(/About 1h 6m of training, done in about 33m 20s on 2 slots/)).toBeTruthy();
  expect(within(panel).getByText(/2 GB of disk.*50 GB are free/)).toBeTruthy();
});

test('a model of the zoo is not said to be trained', async () => {
  const locomotion = [
    { task: 'FetchPush', run_id: null, zoo_success: 1 },
    { task: 'FetchSlide', run_id: 'run-7', zoo_success: 0.99 },
  ];
  server.on('POST /api/studies/preview', () => ({ body: { ...PREVIEW, locomotion } }));
  openPage('/studies/new');
  const sums = await screen.findByText(/Locomotion:/);
  expect(sums.textContent).toBe('Locomotion: 1 from the zoo, 1 reused.');
});

test('variants that came with a study are said to be kept only while no setting has several values', async () => {
  const variant = (gamma: number) => ({ name: `v${gamma}`, overrides: { agent: { gamma, polyak: gamma } } });
  const spec = { ...STUDY.spec, variants: [variant(0.9), variant(0.95)] };
  server.on('GET /api/studies/study-1', () => ({ body: { ...STUDY, spec } }));
  const { user } = openPage('/studies/new?from=study-1');
  expect(await screen.findByText(/are kept as they were/)).toBeTruthy();
  await user.click(screen.getByRole('button', { name: 'Add a setting' }));
  await user.type(await screen.findByRole('textbox', { name: /^Values of/ }), '5, 10');
  await waitFor(() => expect(screen.queryByText(/are kept as they were/)).toBeNull());
});

test('nobody knows is said where nobody does', async () => {
  const estimate = { ...PREVIEW.estimate, training_s: null, until_done_s: null, unknown_runs: 3 };
  server.on('POST /api/studies/preview', () => ({ body: { ...PREVIEW, estimate } }));
  openPage('/studies/new');
  expect(await screen.findByText(/Nobody knows yet how long 3 runs will take/)).toBeTruthy();
});

test('what is chosen is what is launched, under a name of its own', async () => {
  const { user, router } = openPage('/studies/new');
  await user.click(await screen.findByRole('checkbox', { name: 'her-dense' }));
  const seeds = screen.getByRole('textbox', { name: 'Seeds' });
  await user.clear(seeds);
  await user.type(seeds, '0-1');
  await waitFor(() => expect(lastSpec()).toMatchObject({ methods: ['her', 'her-dense', 'her-sldr'], seeds: [0, 1] }));
  await user.click(await screen.findByRole('button', { name: 'Launch 4 runs' }));
  await waitFor(() => expect(router.state.location.pathname).toBe('/studies/study-1'));
  expect(server.bodiesOf('POST', '/api/studies')).toEqual([
    { name: 'FetchPush: her, her-dense, her-sldr', note: '', spec: lastSpec() },
  ]);
});

test('a template fills the form', async () => {
  const { user } = openPage('/studies/new');
  await user.click(await screen.findByRole('button', { name: 'Two minutes of FetchPush' }));
  await waitFor(() => expect(lastSpec()).toMatchObject({ overrides: { loop: { epochs: 5 } }, seeds: [0, 1, 2] }));
  expect(screen.getByRole('textbox', { name: 'Name' })).toHaveProperty('value', 'Two minutes of FetchPush');
  expect(screen.getByRole('textbox', { name: 'Values of loop.epochs' })).toHaveProperty('value', '5');
});

test('several values of a setting become an axis', async () => {
  const { user } = openPage('/studies/new');
  await user.click(await screen.findByRole('button', { name: 'Add a setting' }));
  await user.type(screen.getByRole('textbox', { name: 'Values of loop.epochs' }), '5, 10');
  await waitFor(() =>
    expect(lastSpec()).toMatchObject({ variants: [{ name: 'epochs=5' }, { name: 'epochs=10' }], overrides: {} }),
  );
});

test('a clone begins with the spec of its study', async () => {
  openPage('/studies/new?from=study-1');
  expect(await screen.findByDisplayValue('Copy of Push')).toBeTruthy();
  await waitFor(() => expect(lastSpec()).toEqual(STUDY.spec));
});

test('nothing can be launched without a task, and the page says so', async () => {
  const { user } = openPage('/studies/new');
  await user.click(await screen.findByRole('checkbox', { name: 'FetchPush' }));
  expect(await screen.findByText('Choose at least one task.')).toBeTruthy();
  expect(screen.getByRole('button', { name: 'Launch the study' })).toHaveProperty('disabled', true);
});

test('what the server refuses is said in its words', async () => {
  server.on('POST /api/studies/preview', () => problem(422, 'seeds', 'these are 4000 runs; take fewer.'));
  openPage('/studies/new');
  expect(await screen.findByText('seeds: these are 4000 runs; take fewer.')).toBeTruthy();
});

test('a draft is there again after a look at another page, until it is launched', async () => {
  const { user, router } = openPage('/studies/new');
  const chosen = async (): Promise<boolean> =>
    (await screen.findByRole<HTMLInputElement>('checkbox', { name: 'her-dense' })).checked;
  await user.click(await screen.findByRole('checkbox', { name: 'her-dense' }));
  await act(() => router.navigate({ to: '/studies/new', search: { from: 'study-1' } }));
  expect(await screen.findByDisplayValue('Copy of Push')).toBeTruthy();
  expect(await chosen()).toBe(false);
  await act(async () => router.history.go(-1));
  await waitFor(async () => expect(await chosen()).toBe(true));
  await user.click(await screen.findByRole('button', { name: 'Launch 4 runs' }));
  await waitFor(() => expect(router.state.location.pathname).toBe('/studies/study-1'));
  await act(async () => router.history.go(-1));
  expect(await chosen()).toBe(false);
});
