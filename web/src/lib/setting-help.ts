/** Where settings stand in the paper's equations; what they do is said by the config's schema. */
import type { EquationName } from '@/lib/equations';

/** By the setting's dotted name. */
export const SETTING_EQUATIONS: Readonly<Record<string, EquationName>> = {
  'agent.gamma': 'return',
  'agent.lowest_return': 'critic',
  'agent.lowest_auxiliary_return': 'critic',
  'agent.learning_rate': 'critic',
  'agent.target_rate': 'critic',
  'agent.average_rate': 'actor',
  'agent.action_l2': 'actor',
  'exploration.random_action_probability': 'explore',
  'exploration.noise_std': 'explore',
  'replay.relabel_probability': 'hindsight',
  'replay.met_weight': 'hindsight',
  'sldr.reward': 'sldr',
  'sldr.weight': 'streams',
  'rnd.weight': 'streams',
  'rnd.outputs': 'novelty',
  'curriculum.nearness': 'curriculum',
  'curriculum.nearness_growth': 'curriculum',
};

/** Where a group of settings is told of in the paper. */
export const GROUP_SECTIONS: Readonly<Record<string, string>> = {
  loop: '§6.1',
  agent: '§3.2',
  exploration: '§6.1',
  replay: '§3.3',
  sldr: '§4.2',
  rnd: '§6.2',
  curriculum: '§6.2',
  scene: '§5 and §6.1',
};
