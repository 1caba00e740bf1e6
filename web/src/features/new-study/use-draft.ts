/** The study that is being put together: what was chosen, what it adds up to, and what launching it would do. */
import { useDebouncedValue } from '@mantine/hooks';
import { useQuery } from '@tanstack/react-query';
import { useMemo } from 'react';
import type { Choices, StudySpec } from '@/client/schema.gen';
import { MOST_STUDY_SEEDS, parseSeeds } from '@/lib/seeds';
import { readRows, rowsOf, type SettingRow } from '@/lib/setting-rows';
import { readSettingGroups } from '@/lib/settings';
import { describeAxes } from '@/lib/studies';
import { previewQuery } from '@/lib/study-preview';
import { useKeptDraft } from '@/lib/use-kept-draft';

/** Rest after the last change before the preview is asked for [ms]. */
const REST_MS = 250;

/** What a person chose. */
export interface Draft {
  /** Left empty, the study is named after what it compares. */
  readonly name: string;
  readonly tasks: readonly string[];
  readonly methods: readonly string[];
  readonly seeds: string;
  readonly preset: string;
  /** `zoo`, `train`, or ids of locomotion runs. */
  readonly locomotion: string;
  readonly rows: readonly SettingRow[];
  /** Variants that came with a template or a cloned study and that no row can say. */
  readonly variants: StudySpec['variants'];
}

/** The draft that says the same as a spec. */
export function draftOf(spec: StudySpec, name = ''): Draft {
  return {
    ...rowsOf(spec),
    name,
    tasks: spec.tasks,
    methods: spec.methods,
    seeds: seedText(spec.seeds),
    preset: spec.preset,
    locomotion: spec.locomotion,
  };
}

/** @param beginning what it begins with, in one word: a draft that was left is found again by that */
export function useDraft(begin: Draft, beginning: string, choices: Choices) {
  const { draft, setDraft, forget } = useKeptDraft(begin, { form: 'study', beginning, isDraft });
  const groups = useMemo(() => readSettingGroups(choices.config_schema), [choices.config_schema]);
  const settings = readRows(groups, draft.rows);
  const seeds = readSeeds(draft.seeds);
  const problems = {
    tasks: draft.tasks.length === 0 ? 'Choose at least one task.' : undefined,
    methods: draft.methods.length === 0 ? 'Choose at least one method.' : undefined,
    seeds: seeds.problem,
    rows: settings.problems,
  };
  const isWhole = !problems.tasks && !problems.methods && !problems.seeds && Object.keys(problems.rows).length === 0;
  const spec: StudySpec | null = isWhole
    ? {
        tasks: inOrder(draft.tasks, choices.tasks),
        methods: inOrder(draft.methods, choices.methods),
        seeds: seeds.seeds,
        preset: draft.preset,
        locomotion: draft.locomotion,
        overrides: settings.overrides,
        variants: settings.variants.length > 0 ? settings.variants : (draft.variants ?? []),
      }
    : null;
  // The preview belongs to the study that rested, so a hasty click never launches what was not shown.
  const [resting] = useDebouncedValue(JSON.stringify(spec), REST_MS);
  const preview = useQuery(previewQuery(useMemo(() => JSON.parse(resting) as StudySpec | null, [resting])));
  const isResting = resting === JSON.stringify(spec);
  return {
    draft,
    choose: (changes: Partial<Draft>) => setDraft((old) => ({ ...old, ...changes })),
    /** It is launched: the draft has served. */
    forget,
    groups,
    problems,
    /** Whether the rows name variants, in whose favour those that came with the draft are left out. */
    isVaried: settings.variants.length > 0,
    spec,
    name: draft.name.trim() || (spec ? nameOf(spec) : ''),
    preview: spec !== null && !preview.isError ? preview.data : undefined,
    refusal: spec === null ? null : preview.error,
    isPreviewing: !isResting || preview.isPlaceholderData,
  };
}

export type StudyDraft = ReturnType<typeof useDraft>;

/** Whether something can be a draft; what it names need not be there any more. */
function isDraft(kept: unknown): kept is Draft {
  const { name, tasks, methods, seeds, preset, locomotion, rows, variants } = Object(kept) as Record<string, unknown>;
  const isText = (value: unknown): boolean => typeof value === 'string';
  const isListOf = (value: unknown, isOne: (one: unknown) => boolean): boolean =>
    Array.isArray(value) && value.every(isOne);
  const isRow = (row: unknown): boolean => isText(Object(row).path) && isText(Object(row).text);
  const isVariant = (one: unknown): boolean => isText(Object(one).name) && Object(one).overrides instanceof Object;
  return (
    [name, seeds, preset, locomotion].every(isText) &&
    [tasks, methods].every((names) => isListOf(names, isText)) &&
    isListOf(rows, isRow) &&
    isListOf(variants, isVariant)
  );
}

/** What a study is called after what it compares. */
function nameOf(spec: StudySpec): string {
  const words = `${spec.tasks.join(', ')}: ${spec.methods.join(', ')}`;
  return words.length <= 60 ? words : describeAxes(spec);
}

/** Names in the order in which they are shown, whatever order they were chosen in. */
function inOrder(names: readonly string[], known: readonly { name: string }[]): string[] {
  return known.map(({ name }) => name).filter((name) => names.includes(name));
}

function readSeeds(text: string): { seeds: number[]; problem?: string } {
  try {
    return { seeds: parseSeeds(text, MOST_STUDY_SEEDS) };
  } catch (error) {
    return { seeds: [], problem: (error as Error).message };
  }
}

function seedText(seeds: readonly number[]): string {
  const first = Math.min(...seeds);
  const isRange = seeds.length > 1 && seeds.every((seed, place) => seed === first + place);
  return isRange ? `${first}-${first + seeds.length - 1}` : seeds.join(', ');
}
