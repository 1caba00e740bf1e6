/** What each method does and when to choose it, for whoever has to choose. */
import type { EquationName } from '@/lib/equations';

export interface MethodHelp {
  /** Two sentences. */
  readonly does: string;
  readonly equations: readonly EquationName[];
  readonly choose: string;
}

/** By the method's name; a new method gets its words here. */
export const METHOD_HELP: Readonly<Record<string, MethodHelp>> = {
  ddpg: {
    does: 'A critic learns what each action is worth under the sparse reward, and the actor climbs it. Goals stay as they were, so nothing is learnt before the first success.',
    equations: ['sparse', 'critic', 'actor'],
    choose: 'Choose it as the plainest baseline: it shows how hard a task is without any help.',
  },
  her: {
    does: 'Four of five samples get a goal that the same episode reached later, and their reward is computed anew. A failed episode so becomes a success at another goal.',
    equations: ['sparse', 'hindsight'],
    choose: 'Choose it first: it is the baseline that all others build on, and every locomotion run uses it.',
  },
  cher: {
    does: 'It draws more samples than it needs and keeps those whose goals are diverse and near. Nearness counts more with every update.',
    equations: ['hindsight', 'curriculum'],
    choose: 'Choose it to see what a better choice of samples gives, with no further reward. It is slower per update.',
  },
  'her-dense': {
    does: 'Every step is rewarded by how far the object is from its goal, instead of only at the goal. All else is as in HER.',
    equations: ['dense', 'hindsight'],
    choose:
      'Choose it to see whether a reward by distance would do; where the way leads around something, it often does not.',
  },
  'ddpg-sldr': {
    does: 'A second reward compares what the robot made the object do with what the object would have done by itself. Goals stay as they were.',
    equations: ['sldr', 'streams'],
    choose: 'Choose it to see what the demonstrations of the object give by themselves, without hindsight.',
  },
  'her-rnd': {
    does: 'A second reward is given for states that were seldom seen, told by where a learnt network errs against a fixed one. All else is as in HER.',
    equations: ['novelty', 'streams'],
    choose: 'Choose it to compare SLDR with another further reward, one that only asks for what is new.',
  },
  'her-sldr': {
    does: 'A second reward compares what the robot made the object do with what the object would have done by itself, and hindsight replaces goals as in HER. The object learns first, in a locomotion run; each object has a reward and a critic of its own.',
    equations: ['sldr', 'hindsight', 'streams'],
    choose:
      'Choose it to solve a task: it is the method of the paper, and helps most where grasping or turning is needed.',
  },
};
