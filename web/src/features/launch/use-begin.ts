/** What the form begins with: the presets as they are, or what the run to be launched again was told. */
import { useQueries, useQuery } from '@tanstack/react-query';
import type { Choices, RunDetail } from '@/client/schema.gen';
import { defaultsQuery, runQuery } from '@/lib/queries';
import { reconnecting } from '@/lib/reconnecting';
import { type Config, differences, readSettingGroups, settingText } from '@/lib/settings';

export interface Begin {
  /** The run that is launched again, if one is. */
  readonly run: RunDetail | undefined;
  /** Settings by their dotted path, as a person would type them. */
  readonly typed: Readonly<Record<string, string>>;
  /** Where the run's locomotion models came from: `zoo`, or ids of locomotion runs. */
  readonly locomotion: string;
}

const ANEW: Begin = { run: undefined, typed: {}, locomotion: 'zoo' };

/** What the store tags runs with whose model came with the product. */
const ZOO_TAG = 'zoo';

/** @param from the id of the run that is launched again */
export function useBegin(choices: Choices, from: string | undefined) {
  const still = { refetchInterval: reconnecting };
  const run = useQuery({ ...runQuery(from ?? ''), ...still, enabled: from !== undefined });
  const told = run.data;
  const { task = '', phase = 'manipulation', method = '', preset = '' } = told ?? {};
  const defaults = useQuery({ ...defaultsQuery({ task, phase, method, preset }), enabled: told !== undefined });
  const needed = useQueries({ queries: (told?.needs ?? []).map((id) => ({ ...runQuery(id), ...still })) });
  const parts = from === undefined ? [] : [run, defaults, ...needed];
  const missing = parts.filter((part) => part.data === undefined);
  const found = needed.flatMap(({ data }) => data ?? []);
  return {
    begin:
      from === undefined
        ? ANEW
        : told && defaults.data && missing.length === 0
          ? beginAs(told, choices, defaults.data, found)
          : undefined,
    error: missing.find((part) => part.error)?.error,
    retry: () => missing.forEach((part) => void (part.error && part.refetch())),
  };
}

function beginAs(run: RunDetail, choices: Choices, defaults: Config, needed: readonly RunDetail[]): Begin {
  // A setting that the run's config lacks is one it was never asked for.
  const changed = differences(readSettingGroups(choices.config_schema), run.config, defaults).filter(
    ({ value }) => value !== null,
  );
  return {
    run,
    typed: Object.fromEntries(changed.map(({ setting, value }) => [setting.path, settingText(value)])),
    locomotion: needed.every((one) => one.tags.includes(ZOO_TAG)) ? 'zoo' : run.needs.join(','),
  };
}
