import { expect, test } from 'vitest';
import { COMPARISON } from '@/testing/comparison';
import { standingOut } from './view';

const { groups } = COMPARISON;

test('the curve near the mouse stands out, else the pinned group', () => {
  expect(standingOut(groups, { key: 'her', runId: 'run-7' }, 'her-sldr')).toEqual({ key: 'her', runId: 'run-7' });
  expect(standingOut(groups, null, 'her-sldr')).toEqual({ key: 'her-sldr' });
  expect(standingOut(groups, null, undefined)).toBeNull();
});

test('a group that is gone fades no other', () => {
  expect(standingOut(groups, null, 'her|quick')).toBeNull();
  expect(standingOut(groups, { key: 'her|quick' }, 'her')).toEqual({ key: 'her' });
});
