/** Plausible recorded episodes. */
import type { Episode, EpisodeList, EpisodeTimelines } from '@/client/schema.gen';

export const EPISODE: Episode = {
  epoch: 2,
  index: 0,
  attempt: 1,
  success: false,
  tag: 'too_slow',
  task_return: -3,
  worst_q: -0.8,
  worst_q_step: 1,
  length: 3,
  resimulates: true,
  file: 'episodes-epoch-0002.npz',
};

export const EPISODES: EpisodeList = {
  episodes: [EPISODE, { ...EPISODE, index: 1, tag: 'success', success: true, task_return: -1, resimulates: false }],
  total: 2,
  epochs: [1, 2],
};

export const TIMELINES: EpisodeTimelines = {
  episode: EPISODE,
  env_steps: 3800,
  distance: [0.3, 0.2, 0.15, 0.1],
  angle: null,
  success: [false, false, false, false],
  contact: { object0: [false, true, true, false] },
  rewards: { task: [-1, -1, -1], 'sldr/object0': [-0.1, -0.8, -0.3] },
  values: { task: [-9, -8, -7], 'sldr/object0': [-2, -2, -1] },
  wanted: { object0: [[0], [0], [0]] },
  induced: { object0: [[0], [0], [0]] },
};
