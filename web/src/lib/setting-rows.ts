/** Settings of a study as a person writes them: one value for every run, or several to be compared. */
import type { StudySpec } from '@/client/schema.gen';
import {
  BadSetting,
  parseSetting,
  type Setting,
  type SettingGroup,
  type SettingValue,
  settingText,
} from '@/lib/settings';

/** One setting and its values, as typed. */
export interface SettingRow {
  readonly path: string;
  readonly text: string;
}

/** What rows add up to. */
export interface ReadRows {
  readonly overrides: Nested;
  readonly variants: { name: string; overrides: Nested }[];
  /** A sentence for each row that cannot be meant, by its place. */
  readonly problems: Readonly<Record<number, string>>;
}

type Nested = Record<string, Record<string, SettingValue>>;

/** Read rows; at most one of them may have several values. */
export function readRows(groups: readonly SettingGroup[], rows: readonly SettingRow[]): ReadRows {
  const settings = new Map(groups.flatMap((group) => group.settings.map((setting) => [setting.path, setting])));
  const overrides: Nested = {};
  let variants: ReadRows['variants'] = [];
  const problems: Record<number, string> = {};
  rows.forEach(({ path, text }, place) => {
    const setting = settings.get(path);
    if (setting === undefined) return;
    try {
      if (rows.findIndex((row) => row.path === path) < place) throw new BadSetting('This setting is named above.');
      const values = valuesOf(setting, text);
      const [only] = values;
      if (values.length === 1 && only !== undefined) putAt(overrides, path, only);
      else if (variants.length > 0) throw new BadSetting('One setting at a time can have several values.');
      else variants = values.map((value) => variantOf(setting, value));
    } catch (error) {
      if (!(error instanceof BadSetting)) throw error;
      problems[place] = error.message;
    }
  });
  return { overrides, variants, problems };
}

/** Read a row as variants, also if it has one value alone; an empty one has none. */
export function readVariants(
  groups: readonly SettingGroup[],
  { path, text }: SettingRow,
): { variants: ReadRows['variants']; problem?: string } {
  const setting = groups.flatMap((group) => group.settings).find((known) => known.path === path);
  if (setting === undefined || text.trim() === '') return { variants: [] };
  try {
    return { variants: valuesOf(setting, text).map((value) => variantOf(setting, value)) };
  } catch (error) {
    if (!(error instanceof BadSetting)) throw error;
    return { variants: [], problem: error.message };
  }
}

/** The rows that say the same as a spec, and its variants if no row can. */
export function rowsOf(spec: StudySpec): { rows: SettingRow[]; variants: StudySpec['variants'] } {
  const rows = leaves(spec.overrides ?? {}).map(([path, value]) => ({ path, text: settingText(value) }));
  const variants = spec.variants ?? [];
  const varied = variants.map((variant) => leaves(variant.overrides));
  const [path] = varied[0]?.[0] ?? [];
  const isOneSetting =
    path !== undefined && varied.every((settings) => settings.length === 1 && settings[0]?.[0] === path);
  if (!isOneSetting) return { rows, variants };
  const values = varied.map((settings) => settings[0]?.[1] ?? null);
  const mark = values.some(Array.isArray) ? ' | ' : ', ';
  return { rows: [...rows, { path, text: values.map(settingText).join(mark) }], variants: [] };
}

/** Several values are set apart by commas, lists by upright strokes. */
function valuesOf(setting: Setting, text: string): SettingValue[] {
  const mark = setting.kind === 'integers' || text.includes('|') ? '|' : ',';
  const values = text.split(mark).map((part) => parseSetting(setting, part));
  const texts = values.map(settingText);
  if (new Set(texts).size < texts.length) throw new BadSetting('A value is written twice.');
  return values;
}

function variantOf(setting: Setting, value: SettingValue): ReadRows['variants'][number] {
  const overrides: Nested = {};
  putAt(overrides, setting.path, value);
  return { name: `${setting.path.split('.').at(-1)}=${settingText(value)}`.slice(0, 80), overrides };
}

function putAt(nested: Nested, path: string, value: SettingValue): void {
  const [group = '', key = ''] = path.split('.');
  nested[group] = { ...nested[group], [key]: value };
}

/** Nested settings as dotted paths and values. */
export function leaves(nested: Readonly<Record<string, unknown>>): [string, SettingValue][] {
  return Object.entries(nested).flatMap(([group, values]) =>
    Object.entries(Object(values)).map(
      ([key, value]) => [`${group}.${key}`, value as SettingValue] as [string, SettingValue],
    ),
  );
}
