import { expect, test } from 'vitest';
import type { EpisodeTimelines } from '@/client/schema.gen';
import { NO_METRICS } from '@/lib/metrics';
import { EPISODE, TIMELINES } from '@/testing/episode-samples';
import { readRunSearch } from '../search';
import { episodeName, pressed, readEpisode, searchOf, sortingOf } from './place';
import { describeShares, labelled, stacked, testShares } from './shares';
import { momentsOf, timelinesOf } from './timelines';

const METRICS = {
  ...NO_METRICS,
  epoch: [1, 1, 2],
  values: {
    'episodes/success_share': [null, 0, 0.5],
    'episodes/never_touched_share': [null, 0.75, 0],
    'episodes/other_share': [null, 0.25, 0.5],
  },
};

test('an episode is named and read by epoch and index', () => {
  expect(readEpisode(episodeName({ epoch: 12, index: 10 }))).toEqual({ epoch: 12, index: 10 });
  for (const raw of ['12', '12.', '1.2.3', 'a.b', '-1.2', undefined]) expect(readEpisode(raw)).toBeUndefined();
});

test('the address keeps what makes sense', () => {
  const read = readRunSearch({
    tab: 'episodes',
    episode: '12.10',
    tag: 'dropped',
    test: '12',
    sort: 'return',
    order: 'up',
  });
  expect(read).toMatchObject({
    tab: 'episodes',
    episode: '12.10',
    tag: 'dropped',
    test: 12,
    sort: 'return',
    order: 'up',
  });
  const left = readRunSearch({ episode: 'x', tag: 'lost', test: '-1', sort: 'size', order: 'sideways' });
  expect(Object.values(left).every((value) => value === undefined)).toBe(true);
});

test('the newest test comes first; a press turns the order, or begins with the worst', () => {
  const newest = sortingOf({});
  expect(newest).toEqual({ sort: 'epoch', descending: true });
  expect(pressed(newest, 'epoch')).toEqual({ sort: 'epoch', descending: false });
  expect(pressed(newest, 'worst_q')).toEqual({ sort: 'worst_q', descending: false });
  expect(searchOf({ sort: 'epoch', descending: true })).toEqual({ sort: undefined, order: undefined });
  expect(sortingOf(searchOf({ sort: 'return', descending: true }))).toEqual({ sort: 'return', descending: true });
});

test('shares are those of the cycles that held a test', () => {
  const tests = testShares(METRICS);
  expect(tests.map(({ epoch }) => epoch)).toEqual([1, 2]);
  expect(tests.map(describeShares)).toEqual([
    'epoch 1: never touched 75\u202f%, other 25\u202f%',
    'epoch 2: success 50\u202f%, other 50\u202f%',
  ]);
});

test('what happened is stacked without gaps, success at the bottom', () => {
  const [, second] = testShares(METRICS);
  expect(second && stacked(second)).toEqual([
    { tag: 'success', from: 0, to: 0.5 },
    { tag: 'other', from: 0.5, to: 1 },
  ]);
});

test('of many tests a few round ones are labelled', () => {
  const tests = Array.from({ length: 50 }, (_, at) => ({ ...testShares(METRICS)[0], epoch: at + 1 }));
  expect([...labelled(tests as never, 12)]).toEqual([1, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50]);
  expect([...labelled(tests.slice(0, 3) as never, 12)]).toEqual([1, 2, 3]);
});

test('every chart of an episode has a value for each moment, or a gap', () => {
  const charts = timelinesOf(TIMELINES);
  expect(charts.map(({ title }) => title)).toEqual([
    'q',
    'Task reward',
    'Q values',
    'Distance to the goal [m]',
    'Touched by the robot',
  ]);
  for (const { lines } of charts) {
    for (const { raw } of lines) expect(raw).toHaveLength(momentsOf(TIMELINES).length);
  }
  expect(charts[0]?.lines[0]).toMatchObject({ label: 'sldr/object0', raw: [-0.1, -0.8, -0.3, null] });
  expect(charts[4]?.lines[0]?.raw).toEqual([0, 1, 1, 0]);
});

test('what an episode has nothing of is left out', () => {
  const bare: EpisodeTimelines = {
    ...TIMELINES,
    episode: EPISODE,
    rewards: { task: [-1, -1, -1] },
    contact: { object: [false, false, false, false] },
    angle: [0.4, 0.3, 0.2, 0.1],
  };
  expect(timelinesOf(bare).map(({ title }) => title)).toEqual([
    'Task reward',
    'Q values',
    'Distance to the goal [m]',
    'Angle from the goal [rad]',
  ]);
});
