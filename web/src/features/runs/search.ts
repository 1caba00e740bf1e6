/** What the runs table shows, as it stands in the address: filters, order, columns, groups. */
import type { RunState } from '@/client/schema.gen';
import { RUN_STATES } from '@/lib/states';
import { BUILT_IN_KEYS, type BuiltIn } from './columns';
import { isMetricColumn } from './metric-columns';

export const PHASES = ['locomotion', 'manipulation'] as const;
export type Phase = (typeof PHASES)[number];

/** What runs can be grouped by; `settings` is the whole config without the seed. */
export const GROUP_KEYS = ['task', 'phase', 'method', 'preset', 'settings', 'state'] as const;
export type GroupKey = (typeof GROUP_KEYS)[number];

/** What runs of a group share if they differ in the seed alone. */
export const ALL_BUT_SEED: readonly GroupKey[] = ['task', 'phase', 'method', 'preset', 'settings'];

type Texts = readonly string[];

/** What narrows the table. Lists stand in the address with commas. */
export interface RunsFilter {
  readonly state?: readonly RunState[];
  readonly task?: Texts;
  readonly phase?: readonly Phase[];
  readonly method?: Texts;
  readonly preset?: Texts;
  /** Hash of all settings but the seed. */
  readonly settings?: string;
  /** Tags that a run must all have. */
  readonly tag?: Texts;
  /** Tags of which it must have one. */
  readonly any_tag?: Texts;
  /** Tags of which it must have none. */
  readonly no_tag?: Texts;
  readonly seed_from?: number;
  readonly seed_to?: number;
  /** Success of the newest test, 0 to 1. */
  readonly success_from?: number;
  readonly success_to?: number;
  readonly search?: string;
  /** Whether the deleted runs are shown, instead of all others. */
  readonly deleted?: 'yes';
}

export interface RunsSearch extends RunsFilter {
  /** A built-in column's key, a metric column, or of groups `runs` or `median`. Left out: by launch. */
  readonly sort?: string;
  /** Left out: as the column has it. */
  readonly order?: 'up' | 'down';
  /** Metric columns, such as `test/success_rate:best`. */
  readonly columns?: Texts;
  /** Built-in columns that are shown; left out: the usual ones. */
  readonly show?: readonly BuiltIn[];
  readonly group?: readonly GroupKey[];
  /** The metric whose spread each group shows. */
  readonly spread?: string;
  /** Groups that are open, each by its keys. */
  readonly open?: Texts;
}

/** Read an address; what makes no sense is left out. */
export function readRunsSearch(raw: Record<string, unknown>): RunsSearch {
  const text = (key: string): string | undefined =>
    raw[key] == null || raw[key] === '' ? undefined : String(raw[key]);
  const list = (key: string): Texts | undefined => some([...new Set(text(key)?.split(',').filter(Boolean))]);
  const known = <T extends string>(key: string, all: readonly T[]): readonly T[] | undefined =>
    some(all.filter((word) => list(key)?.includes(word)));
  const number = (key: string, most: number): number | undefined => {
    const value = Number(text(key) ?? Number.NaN);
    return value >= 0 && value <= most ? value : undefined;
  };
  const order = text('order');
  return {
    state: known('state', RUN_STATES),
    task: list('task'),
    phase: known('phase', PHASES),
    method: list('method'),
    preset: list('preset'),
    settings: text('settings'),
    tag: list('tag'),
    any_tag: list('any_tag'),
    no_tag: list('no_tag'),
    seed_from: whole(number('seed_from', 2 ** 31 - 1)),
    seed_to: whole(number('seed_to', 2 ** 31 - 1)),
    success_from: number('success_from', 1),
    success_to: number('success_to', 1),
    search: text('search')?.slice(0, 200),
    deleted: raw.deleted === 'yes' ? 'yes' : undefined,
    sort: text('sort'),
    order: order === 'up' || order === 'down' ? order : undefined,
    columns: some(list('columns')?.filter(isMetricColumn).slice(0, MOST_METRIC_COLUMNS)),
    show: known('show', BUILT_IN_KEYS),
    group: known('group', GROUP_KEYS),
    spread: isMetricColumn(text('spread') ?? '') ? text('spread') : undefined,
    open: list('open'),
  };
}

/** As many metrics as one table may show. */
export const MOST_METRIC_COLUMNS = 12;

/** What narrows the table, without order, columns and groups. */
export function filterOf(search: RunsSearch): RunsFilter {
  const { sort, order, columns, show, group, spread, open, ...filter } = search;
  return filter;
}

/** The same as the server reads it. */
export function filterQuery({ deleted, ...filter }: RunsFilter) {
  return { ...filter, deleted: deleted === 'yes' } as {
    [Key in keyof RunsFilter]: Key extends 'deleted' ? boolean : Mutable<RunsFilter[Key]>;
  };
}

type Mutable<T> = T extends readonly (infer Item)[] ? Item[] : T;

/** Whether anything is left out of the table. */
export function isNarrowed(search: RunsSearch): boolean {
  const { deleted, ...filter } = filterOf(search);
  return Object.values(filter).some((value) => value !== undefined);
}

function some<T>(list: readonly T[] | undefined): readonly T[] | undefined {
  return list === undefined || list.length === 0 ? undefined : list;
}

function whole(value: number | undefined): number | undefined {
  return value !== undefined && Number.isInteger(value) ? value : undefined;
}
