/** The switches by which ablations differ, in words. */
import type { RunDetail } from '@/client/schema.gen';
import { formatShare } from '@/lib/format';
import { type Config, isSame, type SettingValue, valueAt } from '@/lib/settings';

/** One switch of a run. */
export interface Switch {
  readonly path: string;
  readonly label: string;
  readonly text: string;
  /** How the preset has it, where that is otherwise. */
  readonly usual?: string;
}

interface Kind {
  readonly path: string;
  readonly label: string;
  /** Whether it has any meaning for a run that learns with or without SLDR. */
  readonly applies: (phase: RunDetail['phase'], usesSldr: boolean) => boolean;
  readonly describe: (value: SettingValue) => string;
}

const KINDS: readonly Kind[] = [
  {
    path: 'replay.relabel_probability',
    label: 'Relabelled goals',
    applies: () => true,
    describe: (value) => formatShare(Number(value)),
  },
  {
    path: 'sldr.reward',
    label: 'SLDR reward',
    applies: (_phase, usesSldr) => usesSldr,
    describe: (value) =>
      words(value, { advantage: 'Eq. 8, difference of Q', action_distance: 'Eq. 7, action distance' }),
  },
  {
    path: 'sldr.gate',
    label: 'Gate',
    applies: (_phase, usesSldr) => usesSldr,
    describe: (value) => (Number(value) === 0 ? 'none' : formatShare(Number(value))),
  },
  {
    path: 'scene.locomotion_robot',
    label: 'Robot while the object learns',
    applies: (phase, usesSldr) => phase === 'locomotion' || usesSldr,
    describe: (value) =>
      words(value, { auto: 'as the task needs', absent: 'removed', still: 'kept still', random: 'acts at random' }),
  },
  {
    path: 'scene.variant',
    label: 'Task numbers',
    applies: () => true,
    describe: (value) => words(value, { ours: 'the paper’s', original: 'the authors’ code’s' }),
  },
];

/** The switches that mean something for a run. */
export function switchesOf(run: RunDetail, usesSldr: boolean, defaults: Config | undefined): Switch[] {
  return KINDS.filter(({ path, applies }) => applies(run.phase, usesSldr) && valueAt(run.config, path) !== null).map(
    ({ path, label, describe }) => {
      const value = valueAt(run.config, path);
      const usual = defaults === undefined ? value : valueAt(defaults, path);
      return { path, label, text: describe(value), usual: isSame(value, usual) ? undefined : describe(usual) };
    },
  );
}

function words(value: SettingValue, names: Readonly<Record<string, string>>): string {
  return names[String(value)] ?? String(value);
}
