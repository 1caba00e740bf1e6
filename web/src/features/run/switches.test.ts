import { expect, test } from 'vitest';
import type { RunDetail } from '@/client/schema.gen';
import { DETAIL } from '@/testing/samples';
import { switchesOf } from './switches';

const CONFIG = {
  replay: { relabel_probability: 0.8 },
  sldr: { reward: 'advantage', gate: 0.95 },
  scene: { locomotion_robot: 'auto', variant: 'ours' },
};
const RUN: RunDetail = { ...DETAIL, config: CONFIG };

test('a run with SLDR shows all its switches in words', () => {
  const shown = switchesOf(RUN, true, CONFIG).map(({ label, text }) => `${label}: ${text}`);
  expect(shown).toEqual([
    'Relabelled goals: 80\u202f%',
    'SLDR reward: Eq. 8, difference of Q',
    'Gate: 95\u202f%',
    'Robot while the object learns: as the task needs',
    'Task numbers: the paper’s',
  ]);
});

test('without SLDR its switches are left out', () => {
  const paths = switchesOf(RUN, false, CONFIG).map(({ path }) => path);
  expect(paths).toEqual(['replay.relabel_probability', 'scene.variant']);
});

test('in locomotion the robot is a switch', () => {
  const paths = switchesOf({ ...RUN, phase: 'locomotion' }, false, CONFIG).map(({ path }) => path);
  expect(paths).toContain('scene.locomotion_robot');
});

test('a switch that was turned is marked, and a new word is shown as it is', () => {
  const turned = { ...RUN, config: { ...CONFIG, sldr: { reward: 'something_new', gate: 0 } } };
  const [, reward, gate] = switchesOf(turned, true, CONFIG);
  expect([reward?.text, reward?.usual]).toEqual(['something_new', 'Eq. 8, difference of Q']);
  expect([gate?.text, gate?.usual]).toEqual(['none', '95\u202f%']);
});
