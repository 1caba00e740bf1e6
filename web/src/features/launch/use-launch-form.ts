/** The state of the launch form: the choices in the address, the settings that were typed, and what they add up to. */
import { useDebouncedValue } from '@mantine/hooks';
import { useQuery } from '@tanstack/react-query';
import { useMemo } from 'react';
import type { Choices, Launch } from '@/client/schema.gen';
import { defaultsQuery } from '@/lib/queries';
import { parseSeeds } from '@/lib/seeds';
import { overridesOf, readSettingGroups } from '@/lib/settings';
import { useKeptDraft } from '@/lib/use-kept-draft';
import { planQuery } from './api/plan-launch';
import { fieldProblems } from './field-problems';
import type { LaunchSearch } from './search';
import type { Begin } from './use-begin';

/** Rest after the last change before the plan is asked for [ms]. */
const REST_MS = 250;

const CHOICE_FIELDS = ['task', 'phase', 'method', 'preset', 'seeds', 'locomotion'];

/** Every choice made, by the person or by default. */
export type Chosen = Required<Omit<LaunchSearch, 'from'>>;

/** Fill the choices that the address leaves open. */
export function fillChoices(search: LaunchSearch, choices: Choices, begin: Begin): Chosen {
  const phase = search.phase ?? 'manipulation';
  const methods = choices.methods.filter((method) => method.phases.includes(phase));
  const pick = (wanted: string, names: readonly string[]): string =>
    names.includes(wanted) ? wanted : (names[0] ?? '');
  const methodNames = methods.map((method) => method.name);
  const task = search.task ?? choices.tasks[0]?.name ?? '';
  return {
    task,
    phase,
    method: pick(search.method ?? (phase === 'manipulation' ? 'her-sldr' : 'her'), methodNames),
    preset:
      search.preset ??
      pick(
        'quick',
        choices.presets.map((preset) => preset.name),
      ),
    seeds: search.seeds ?? '0',
    // Locomotion runs serve their own task alone.
    locomotion: search.locomotion ?? (begin.run?.task === task ? begin.locomotion : 'zoo'),
  };
}

export function useLaunchForm(search: LaunchSearch, choices: Choices, begin: Begin) {
  const chosen = fillChoices(search, choices, begin);
  const { task, phase, method, preset } = chosen;
  const {
    draft: typed,
    setDraft: setTyped,
    forget,
  } = useKeptDraft(begin.typed, {
    form: 'launch',
    beginning: JSON.stringify([search.from, task, phase, method, preset]),
    isDraft: isTyped,
  });
  const groups = useMemo(() => readSettingGroups(choices.config_schema), [choices.config_schema]);
  const known = useMemo(
    () => new Set([...CHOICE_FIELDS, ...groups.flatMap((group) => group.settings.map((setting) => setting.path))]),
    [groups],
  );
  const defaults = useQuery(defaultsQuery({ task, phase, method, preset }));
  const overrides = overridesOf(groups, typed, defaults.data ?? {});
  const seeds = readSeeds(chosen.seeds);
  const isReadable = seeds.problem === undefined && Object.keys(overrides.problems).length === 0;
  const launch: Launch | null =
    isReadable && defaults.data
      ? { task, phase, method, preset, seeds: seeds.seeds, overrides: overrides.values, locomotion: chosen.locomotion }
      : null;
  // The plan belongs to the launch that rested, so a hasty click never launches what was not shown.
  const [resting] = useDebouncedValue(JSON.stringify(launch), REST_MS);
  const isResting = resting === JSON.stringify(launch);
  const plan = useQuery(planQuery(useMemo(() => JSON.parse(resting) as Launch | null, [resting])));
  const refused = fieldProblems(launch === null ? defaults.error : (plan.error ?? defaults.error), known);
  const problems: Record<string, string> = { ...refused.fields, ...overrides.problems };
  if (seeds.problem !== undefined) problems.seeds = seeds.problem;
  return {
    chosen,
    groups,
    known,
    defaults: defaults.data,
    typed,
    changed: overrides.changed,
    launch,
    plan: launch !== null && !plan.isError ? plan.data : undefined,
    isPlanning: !isResting || plan.isPlaceholderData,
    problems,
    otherProblems: refused.others,
    type: (path: string, text: string | undefined) =>
      setTyped(({ [path]: _, ...rest }) => (text === undefined ? rest : { ...rest, [path]: text })),
    resetSettings: () => setTyped({}),
    /** It is launched: what was typed has served. */
    forget,
  };
}

export type LaunchForm = ReturnType<typeof useLaunchForm>;

/** Whether something can be settings by their dotted path, as typed. */
function isTyped(kept: unknown): kept is Begin['typed'] {
  return kept instanceof Object && Object.values(kept).every((text) => typeof text === 'string');
}

function readSeeds(text: string): { seeds: number[]; problem?: string } {
  try {
    return { seeds: parseSeeds(text) };
  } catch (error) {
    return { seeds: [], problem: (error as Error).message };
  }
}
