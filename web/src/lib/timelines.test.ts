import { expect, test } from 'vitest';
import { formatTimelineValue, type Timeline, timelineCharts, worstQStep } from './timelines';

const TIMELINE: Timeline = {
  version: 1,
  known: 3,
  steps: 3,
  columns: {
    'contact/object0': [0, 1, 1, 0],
    'q/object0': [-0.1, -0.4, null],
    'q/object1': [0, -0.9, -0.9],
    'distance/goal': [0.1, 0.05, 0.02, 0.01],
  },
};

test('curves are sorted into charts, in the order of the page', () => {
  const charts = timelineCharts(TIMELINE);
  expect(charts.map(({ group }) => group)).toEqual(['q', 'distance', 'contact']);
  expect(charts[0]?.curves.map(({ label }) => label)).toEqual(['object0', 'object1']);
});

test('distances are shown in centimetres', () => {
  const distance = timelineCharts(TIMELINE).find(({ group }) => group === 'distance');
  expect(distance?.curves[0]?.values).toEqual([10, 5, 2, 1]);
});

test('the worst q is the first of the least of any part', () => {
  expect(worstQStep(TIMELINE)).toBe(1);
  expect(worstQStep({ ...TIMELINE, columns: { 'reward/task': [-1] } })).toBeUndefined();
});

test('values are written with their unit, contacts as yes and no', () => {
  const [q, distance, contact] = timelineCharts(TIMELINE);
  if (!q || !distance || !contact) throw new Error('three charts expected');
  expect(formatTimelineValue(q, -0.12345)).toBe('-0.123');
  expect(formatTimelineValue(distance, 4.25)).toBe('4.3\u202fcm');
  expect(formatTimelineValue(contact, 1)).toBe('yes');
  expect(formatTimelineValue(q, undefined)).toBe('–');
});
