import { expect, test } from 'vitest';
import type { RunFile } from '@/client/schema.gen';
import { episodeCount, FIRST_CHOICE, policyNames, recordedEpochs, sceneRequest } from './scene-choice';

function file(name: string, kind: string): RunFile {
  return { name, kind, size: 1, sha256: '', created_at: '', url: '', ticket: null };
}

const FILES = [
  file('checkpoint.pt', 'checkpoint'),
  file('curves-attempt-1.rrd', 'recording'),
  file('episodes-epoch-0002.npz', 'episodes'),
  file('episodes-epoch-0010.npz', 'episodes'),
  file('policy-epoch-0001.pt', 'policy'),
];

test('policies and recorded epochs are found among the files', () => {
  expect(policyNames(FILES)).toEqual(['checkpoint.pt', 'policy-epoch-0001.pt']);
  expect(recordedEpochs(FILES)).toEqual([10, 2]);
});

test('as many episodes can be chosen as were recorded, and the one that an address names', () => {
  const config = (recorded_episodes: number, test_episodes = 100) => ({ loop: { recorded_episodes, test_episodes } });
  expect(episodeCount(config(20), 0)).toBe(20);
  expect(episodeCount(config(20, 10), 0)).toBe(10);
  expect(episodeCount(config(2), 0)).toBe(2);
  expect(episodeCount(config(2), 4)).toBe(5);
  expect(episodeCount({ loop: {} }, 0)).toBe(6);
});

test('each kind asks for what it needs', () => {
  expect(sceneRequest('r', FIRST_CHOICE)).toEqual({
    kind: 'live',
    run_id: 'r',
    policy: 'newest',
    episodes: 1,
    beside: null,
  });
  expect(sceneRequest('r', { ...FIRST_CHOICE, kind: 'episode', epoch: 3, index: 2 })).toEqual({
    kind: 'episode',
    run_id: 'r',
    epoch: 3,
    index: 2,
  });
  expect(sceneRequest('r', { ...FIRST_CHOICE, kind: 'time-machine' })).toEqual({ kind: 'time-machine', run_id: 'r' });
});

test('two policies are compared in one episode each', () => {
  expect(sceneRequest('r', { ...FIRST_CHOICE, episodes: 9, beside: 's/policy-best.pt' })).toMatchObject({
    episodes: 1,
    beside: { run_id: 's', policy: 'policy-best.pt' },
  });
});
