import { screen, waitFor, within } from '@testing-library/react';
import { beforeEach, expect, test, vi } from 'vitest';
import { type FakeServer, problem } from '@/testing/fake-server';
import { openPage, startServer } from '@/testing/open-page';
import { CHOICES, DEFAULTS, DETAIL, RUN } from '@/testing/samples';

const PLANNED = {
  task: 'FetchPush',
  method: 'her-sldr',
  seed: 0,
  config: DEFAULTS,
  reused_run_id: null,
  zoo_success: null,
  equal_run_id: null,
};

let server: FakeServer;
beforeEach(() => {
  server = startServer()
    .on('POST /api/launches/plan', () => ({
      body: {
        runs: [
          { ...PLANNED, phase: 'locomotion', method: 'her' },
          { ...PLANNED, phase: 'manipulation' },
        ],
      },
    }))
    .on('POST /api/launches', () => ({ status: 201, body: { runs: [{ ...RUN, id: 'l', phase: 'locomotion' }, RUN] } }))
    .on('GET /api/runs/run-1', () => ({ body: DETAIL }));
});

test('the plan says that the locomotion run comes first', async () => {
  openPage('/launch');
  const plan = await screen.findByRole('complementary', { name: 'What will be queued' });
  expect(await within(plan).findByText('2 runs')).toBeTruthy();
  expect(within(plan).getByText('added first: the robot learns from its model')).toBeTruthy();
});

test('a model of the zoo is told with its measured success, and is not queued', async () => {
  server.on('POST /api/launches/plan', () => ({
    body: {
      runs: [
        { ...PLANNED, phase: 'locomotion', method: 'her', zoo_success: 0.987 },
        { ...PLANNED, phase: 'manipulation' },
      ],
    },
  }));
  const { user } = openPage('/launch');
  const plan = await screen.findByRole('complementary', { name: 'What will be queued' });
  expect(await within(plan).findByText('1 run')).toBeTruthy();
  expect(within(plan).getByText(/from the zoo: 98.7\s%/)).toBeTruthy();
  await user.click(screen.getByRole('radio', { name: /^train/ }));
  await waitFor(() =>
    expect(server.bodiesOf('POST', '/api/launches/plan').at(-1)).toMatchObject({ locomotion: 'train' }),
  );
});

test('locomotion runs of other tasks say of which, each in a row of its own', async () => {
  const complaints = vi.spyOn(console, 'error');
  const needed = { ...PLANNED, phase: 'locomotion', method: 'her' };
  server.on('POST /api/launches/plan', () => ({
    body: {
      runs: [
        { ...needed, task: 'HandEggTranslate' },
        { ...needed, task: 'HandEggRotate' },
        { ...PLANNED, phase: 'manipulation' },
      ],
    },
  }));
  openPage('/launch');
  const plan = within(await screen.findByRole('complementary', { name: 'What will be queued' }));
  await plan.findByText('3 runs');
  const rows = plan.getAllByRole('listitem').map(({ textContent }) => textContent);
  expect(rows[0]).toMatch(/^locomotion of HandEggTranslate, her, seed 0/);
  expect(rows[1]).toMatch(/^locomotion of HandEggRotate, her, seed 0/);
  expect(rows[2]).toMatch(/^manipulation, her-sldr, seed 0/);
  expect(complaints.mock.calls.filter(([text]) => String(text).includes('same key'))).toEqual([]);
  complaints.mockRestore();
});

test('a run that only repeats another says so, and is launched all the same', async () => {
  server.on('POST /api/launches/plan', () => ({
    body: {
      runs: [{ ...PLANNED, phase: 'manipulation', equal_run_id: 'run-7' }],
    },
  }));
  openPage('/launch');
  const link = await screen.findByRole('link', { name: 'a run with the same settings and seed' });
  expect(link.getAttribute('href')).toBe('/runs/run-7');
  expect(screen.getByRole('button', { name: 'Launch 1 run' })).toBeTruthy();
});

test('launching sends the choices and leads to the run', async () => {
  const { user, router } = openPage('/launch');
  await user.click(await screen.findByRole('button', { name: 'Launch 2 runs' }));
  await waitFor(() => expect(router.state.location.pathname).toBe('/runs/run-1'));
  expect(server.bodiesOf('POST', '/api/launches')).toEqual([
    {
      task: 'FetchPush',
      phase: 'manipulation',
      method: 'her-sldr',
      preset: 'quick',
      seeds: [0],
      overrides: {},
      locomotion: 'zoo',
    },
  ]);
});

test('only changed settings are sent', async () => {
  const { user } = openPage('/launch');
  await user.click(await screen.findByRole('button', { name: /Advanced settings/ }));
  const field = await screen.findByRole('textbox', { name: 'Batch size' });
  await user.clear(field);
  await user.type(field, '512');
  await waitFor(() =>
    expect(server.bodiesOf('POST', '/api/launches/plan').at(-1)).toMatchObject({
      overrides: { loop: { batch_size: 512 } },
    }),
  );
});

test('a number out of range is marked at its field, and nothing can be launched', async () => {
  const { user } = openPage('/launch');
  await user.click(await screen.findByRole('button', { name: /Advanced settings/ }));
  const field = await screen.findByRole('textbox', { name: 'Batch size' });
  await user.clear(field);
  await user.type(field, '-1');
  expect(await screen.findByText('It must be above 0.')).toBeTruthy();
  expect(field.getAttribute('aria-invalid')).toBe('true');
  expect(screen.getByRole('button', { name: 'Launch' })).toHaveProperty('disabled', true);
});

test('what the server refuses is shown at the field it names', async () => {
  server.on('POST /api/launches/plan', () =>
    problem(422, 'overrides.loop.batch_size', 'It is more than fits in memory.'),
  );
  const { user } = openPage('/launch');
  await user.click(await screen.findByRole('button', { name: /Advanced settings/ }));
  expect(await screen.findByText('It is more than fits in memory.')).toBeTruthy();
  expect(screen.getByRole('textbox', { name: 'Batch size' }).getAttribute('aria-invalid')).toBe('true');
});

test('seeds that cannot be read get a sentence', async () => {
  const { user } = openPage('/launch');
  const seeds = await screen.findByRole('textbox', { name: 'Seeds' });
  await user.clear(seeds);
  expect(await screen.findByText('Enter at least one seed, such as 0.')).toBeTruthy();
});

test('seeds are typed in the middle of others', async () => {
  const { user, router } = openPage('/launch?seeds=3-9');
  const seeds = await screen.findByRole<HTMLInputElement>('textbox', { name: 'Seeds' });
  await user.type(seeds, '1, ', { initialSelectionStart: 0, initialSelectionEnd: 0 });
  expect(seeds.value).toBe('1, 3-9');
  await waitFor(() => expect(router.state.location.search).toMatchObject({ seeds: '1, 3-9' }));
  await user.click(screen.getByRole('checkbox', { name: '0-4' }));
  expect(seeds.value).toBe('0-4');
});

test('a choice leaves the page where it stands', async () => {
  const { user, router } = openPage('/launch');
  const radio = await screen.findByRole('radio', { name: 'her' });
  const scrolling = vi.spyOn(window, 'scrollTo');
  await user.click(radio);
  await waitFor(() => expect(router.state.location.search).toMatchObject({ method: 'her' }));
  await waitFor(() => expect(router.state.resolvedLocation?.search).toMatchObject({ method: 'her' }));
  expect(scrolling).not.toHaveBeenCalled();
});

const AGAIN = '/launch?task=FetchPush&phase=manipulation&method=her-sldr&preset=quick&seeds=3&from=run-1';
const lastPlanned = (): unknown => server.bodiesOf('POST', '/api/launches/plan').at(-1);

test('launching again keeps the changed settings and the locomotion runs, until another task is chosen', async () => {
  server
    .on('GET /api/choices', () => ({
      body: { ...CHOICES, tasks: [...CHOICES.tasks, { ...CHOICES.tasks[0], name: 'FetchSlide' }] },
    }))
    .on('GET /api/runs/run-1', () => ({ body: { ...DETAIL, needs: ['run-0'] } }))
    .on('GET /api/runs/run-0', () => ({ body: { ...DETAIL, id: 'run-0', phase: 'locomotion' } }));
  const { user } = openPage(AGAIN);
  await screen.findByRole('button', { name: 'Launch 2 runs' });
  expect(lastPlanned()).toMatchObject({ seeds: [3], overrides: { agent: { gamma: 0.99 } }, locomotion: 'run-0' });
  await user.click(screen.getByRole('button', { name: /Advanced settings 1 changed/ }));
  await user.click(screen.getByRole('button', { name: /^Agent/ }));
  expect(await screen.findByRole<HTMLInputElement>('textbox', { name: 'Gamma' })).toHaveProperty('value', '0.99');
  await user.click(screen.getByRole('radio', { name: 'FetchSlide' }));
  await waitFor(() => expect(lastPlanned()).toMatchObject({ task: 'FetchSlide', locomotion: 'zoo' }));
});

test('launching again takes the models of the zoo if the run did', async () => {
  server
    .on('GET /api/runs/run-1', () => ({ body: { ...DETAIL, needs: ['run-0'] } }))
    .on('GET /api/runs/run-0', () => ({ body: { ...DETAIL, id: 'run-0', phase: 'locomotion', tags: ['zoo'] } }));
  openPage(AGAIN);
  await screen.findByRole('button', { name: 'Launch 2 runs' });
  expect(lastPlanned()).toMatchObject({ locomotion: 'zoo' });
});

test('a run that cannot be read is not needed to launch', async () => {
  server.on('GET /api/runs/run-1', () => problem(404, null, 'There is no run run-1.'));
  const { user } = openPage(AGAIN);
  expect(await screen.findByText('There is no run run-1.')).toBeTruthy();
  await user.click(screen.getByRole('link', { name: 'Begin without it' }));
  await screen.findByRole('button', { name: 'Launch 2 runs' });
  expect(lastPlanned()).toMatchObject({ seeds: [3], overrides: {} });
});

test('a locomotion run learns with methods of that phase only', async () => {
  const { user } = openPage('/launch');
  await user.click(await screen.findByRole('radio', { name: 'Locomotion' }));
  for (const name of ['her-sldr', 'her-dense']) {
    await waitFor(() => expect(screen.getByRole('radio', { name })).toHaveProperty('disabled', true));
  }
  expect(screen.getByRole('radio', { name: 'her' })).toHaveProperty('checked', true);
});

test('whoever has no run yet is led through three steps, until they are put away', async () => {
  const { user } = openPage('/launch');
  const steps = await screen.findByRole('region', { name: 'Your first run' });
  expect(within(steps).getAllByRole('listitem')).toHaveLength(3);
  await user.click(within(steps).getByRole('button', { name: 'Do not show this again' }));
  expect(screen.queryByRole('region', { name: 'Your first run' })).toBeNull();
  expect(window.localStorage.getItem('sldr-first-steps-away')).toBe('true');
});

test('who has runs is not told how to begin', async () => {
  server.on('GET /api/runs', () => ({ body: { runs: [RUN], values: [[]], next_cursor: null, total: 1 } }));
  openPage('/launch');
  await screen.findByRole('button', { name: 'Launch 2 runs' });
  expect(screen.queryByRole('region', { name: 'Your first run' })).toBeNull();
});

test('each method tells what it does, and asking chooses nothing', async () => {
  const { user } = openPage('/launch');
  await user.click(await screen.findByRole('button', { name: 'What her does' }));
  const help = await screen.findByRole('dialog', { name: 'What her does' });
  expect(within(help).getByRole('img', { name: /^A new goal is drawn/ })).toBeTruthy();
  expect(screen.getByRole<HTMLInputElement>('radio', { name: 'her-sldr' }).checked).toBe(true);
});
