/** What of a run is shown in 3D: what can be chosen, and how the server is asked for it. */
import type { EpisodeView, LiveView, RunFile, TimeMachineView } from '@/client/schema.gen';
import { type Config, valueAt } from '@/lib/settings';

export type SceneRequest = LiveView | EpisodeView | TimeMachineView;

export const SCENE_KINDS = ['live', 'episode', 'time-machine'] as const;
export type SceneKind = (typeof SCENE_KINDS)[number];

export const SCENE_NAMES: Record<SceneKind, string> = {
  live: 'Live policy',
  episode: 'Recorded episode',
  'time-machine': 'Time machine',
};

/** What each kind is for, in a sentence. */
export const SCENE_TEXTS: Record<SceneKind, string> = {
  live: 'The policy acts now, toward random goals or one that you drag; an object can be pushed.',
  episode: 'An episode of a test, as it was; beside the robot stands what the object would have done by itself.',
  'time-machine':
    'One start and one goal under every policy that was kept, simulated anew: see where in training it was learnt.',
};

/** The policy that is followed while it is trained. */
export const NEWEST = 'newest';

/** Everything that can be chosen; what belongs to another kind is kept while one looks around. */
export interface SceneChoice {
  readonly kind: SceneKind;
  readonly policy: string;
  readonly episodes: 1 | 4 | 9;
  /** `run/policy`; empty for none. */
  readonly beside: string;
  readonly epoch: number;
  readonly index: number;
}

export const FIRST_CHOICE: SceneChoice = {
  kind: 'live',
  policy: NEWEST,
  episodes: 1,
  beside: '',
  epoch: 0,
  index: 0,
};

/** How the server is asked for it. */
export function sceneRequest(runId: string, choice: SceneChoice): SceneRequest {
  if (choice.kind === 'episode') return { kind: 'episode', run_id: runId, epoch: choice.epoch, index: choice.index };
  if (choice.kind === 'time-machine') return { kind: 'time-machine', run_id: runId };
  const [otherRun = '', otherPolicy = NEWEST] = choice.beside.split('/');
  const beside = choice.beside === '' ? null : { run_id: otherRun, policy: otherPolicy };
  return { kind: 'live', run_id: runId, policy: choice.policy, episodes: beside ? 1 : choice.episodes, beside };
}

/** The files that a policy can be read from. */
export function policyNames(files: readonly RunFile[]): string[] {
  const kinds = ['policy', 'checkpoint', 'locomotion'];
  return files.filter(({ kind, name }) => kinds.includes(kind) && name.endsWith('.pt')).map(({ name }) => name);
}

/** The epochs whose test was recorded, the newest first. */
export function recordedEpochs(files: readonly RunFile[]): number[] {
  return files
    .map(({ name }) => /^episodes-epoch-(\d+)\.npz$/.exec(name)?.[1])
    .filter((epoch) => epoch !== undefined)
    .map(Number)
    .sort((one, other) => other - one);
}

/** Episodes of a test that were recorded before a config could say how many. */
const USUAL_EPISODES = 6;

/** How many episodes of a test there are to choose from, the chosen one among them. */
export function episodeCount(config: Config, index: number): number {
  const recorded = Number(valueAt(config, 'loop.recorded_episodes') ?? USUAL_EPISODES);
  const tested = Number(valueAt(config, 'loop.test_episodes') ?? recorded);
  return Math.max(Math.min(recorded, tested), index + 1);
}
