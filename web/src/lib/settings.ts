/** The settings of a run, read from the config's JSON schema: what a form may ask for, and what it sends. */
import { formatName } from '@/lib/format';

export type SettingValue = string | number | boolean | readonly number[] | null;
export type Config = Readonly<Record<string, unknown>>;

/** One setting that a form can ask for. */
export interface Setting {
  /** Dotted name: `loop.epochs`. */
  readonly path: string;
  readonly label: string;
  readonly help: string;
  readonly kind: 'integer' | 'number' | 'integers' | 'choice' | 'flag' | 'text';
  /** The words to choose from, where kind is `choice`. */
  readonly options: readonly string[];
  readonly bounds: Bounds;
}

/** Settings that belong together. */
export interface SettingGroup {
  readonly name: string;
  readonly label: string;
  readonly help: string;
  readonly settings: readonly Setting[];
}

interface Bounds {
  readonly least?: number;
  readonly above?: number;
  readonly most?: number;
  readonly below?: number;
}

interface Schema {
  readonly $ref?: string;
  readonly $defs?: Readonly<Record<string, Schema>>;
  readonly properties?: Readonly<Record<string, Schema>>;
  readonly allOf?: readonly Schema[];
  readonly type?: string;
  readonly enum?: readonly unknown[];
  readonly const?: unknown;
  readonly items?: Schema;
  readonly description?: string;
  readonly minimum?: number;
  readonly exclusiveMinimum?: number;
  readonly maximum?: number;
  readonly exclusiveMaximum?: number;
}

/** Read the groups of settings from a config's JSON schema; single settings at the top are chosen elsewhere. */
export function readSettingGroups(root: unknown): SettingGroup[] {
  const schema = follow(root as Schema, root as Schema);
  return Object.entries(schema.properties ?? {}).flatMap(([name, part]) => {
    const group = follow(part, root as Schema);
    if (group.properties === undefined) return [];
    const settings = Object.entries(group.properties).map(([key, field]) =>
      readSetting(`${name}.${key}`, follow(field, root as Schema), root as Schema),
    );
    return [{ name, label: formatGroup(name), help: part.description ?? group.description ?? '', settings }];
  });
}

/** The value at a dotted path of a config. */
export function valueAt(config: Config, path: string): SettingValue {
  const value = path.split('.').reduce<unknown>((part, key) => (part as Config | undefined)?.[key], config);
  return (value ?? null) as SettingValue;
}

/** A value as the text a person would type. */
export function settingText(value: SettingValue): string {
  if (value === null) return '';
  return Array.isArray(value) ? value.join(', ') : String(value);
}

/** Read what a person typed; throws `BadSetting` with a sentence if it cannot be meant. */
export function parseSetting(setting: Setting, text: string): SettingValue {
  const trimmed = text.trim();
  switch (setting.kind) {
    case 'flag':
      return trimmed === 'true';
    case 'choice':
    case 'text':
      return trimmed;
    case 'integers':
      return trimmed.split(',').map((part) => parseNumber(setting, part.trim(), true));
    default:
      return parseNumber(setting, trimmed, setting.kind === 'integer');
  }
}

/** What was typed cannot be meant. */
export class BadSetting extends Error {}

/** What is sent: only values that differ from the defaults, nested as in the config. */
export interface Overrides {
  readonly values: Readonly<Record<string, Record<string, SettingValue>>>;
  /** Dotted paths of the changed settings. */
  readonly changed: readonly string[];
  /** A sentence for each setting that cannot be read. */
  readonly problems: Readonly<Record<string, string>>;
}

/** Compare what was typed with the defaults. */
export function overridesOf(
  groups: readonly SettingGroup[],
  typed: Readonly<Record<string, string>>,
  defaults: Config,
): Overrides {
  const values: Record<string, Record<string, SettingValue>> = {};
  const changed: string[] = [];
  const problems: Record<string, string> = {};
  for (const setting of groups.flatMap((group) => group.settings)) {
    const text = typed[setting.path];
    if (text === undefined) continue;
    try {
      const value = parseSetting(setting, text);
      if (isSame(value, valueAt(defaults, setting.path))) continue;
      const [group = '', key = ''] = setting.path.split('.');
      values[group] = { ...values[group], [key]: value };
      changed.push(setting.path);
    } catch (error) {
      if (!(error instanceof BadSetting)) throw error;
      problems[setting.path] = error.message;
    }
  }
  return { values, changed, problems };
}

/** A setting whose value is not the usual one. */
export interface Difference {
  readonly setting: Setting;
  readonly value: SettingValue;
  readonly usual: SettingValue;
}

/** The settings in which a config differs from the defaults. */
export function differences(groups: readonly SettingGroup[], config: Config, defaults: Config): Difference[] {
  return groups
    .flatMap((group) => group.settings)
    .map((setting) => ({ setting, value: valueAt(config, setting.path), usual: valueAt(defaults, setting.path) }))
    .filter(({ value, usual }) => !isSame(value, usual));
}

/** Whether two setting values are equal, lists by their parts. */
export function isSame(one: unknown, other: unknown): boolean {
  return JSON.stringify(one) === JSON.stringify(other);
}

/** The range a number must lie in, in words: `0 to 1`, `above 0`; empty if any will do. */
export function describeBounds({ bounds: { least, above, most, below } }: Setting): string {
  const low = least !== undefined ? `at least ${least}` : above !== undefined ? `above ${above}` : '';
  const high = most !== undefined ? `at most ${most}` : below !== undefined ? `below ${below}` : '';
  if (least !== undefined && most !== undefined) return `${least} to ${most}`;
  return [low, high].filter(Boolean).join(' and ');
}

function follow(schema: Schema, root: Schema): Schema {
  const ref = schema.$ref ?? schema.allOf?.[0]?.$ref;
  const target = ref === undefined ? undefined : root.$defs?.[ref.replace('#/$defs/', '')];
  return target === undefined ? schema : { ...target, ...schema, $ref: undefined };
}

function readSetting(path: string, schema: Schema, root: Schema): Setting {
  const items = schema.items === undefined ? undefined : follow(schema.items, root);
  const limits = items ?? schema;
  const options = schema.enum ?? (schema.const === undefined ? [] : [schema.const]);
  return {
    path,
    label: formatName(path.split('.').at(-1) ?? path),
    help: schema.description ?? '',
    kind: options.length > 0 ? 'choice' : kindOf(schema.type),
    options: options.map(String),
    bounds: {
      least: limits.minimum,
      above: limits.exclusiveMinimum,
      most: limits.maximum,
      below: limits.exclusiveMaximum,
    },
  };
}

function kindOf(type: string | undefined): Setting['kind'] {
  const kinds: Record<string, Setting['kind']> = {
    integer: 'integer',
    number: 'number',
    array: 'integers',
    boolean: 'flag',
  };
  return kinds[type ?? ''] ?? 'text';
}

/** Groups whose names are initials. */
const SHORT_NAMES: readonly string[] = ['sldr', 'rnd'];

function formatGroup(name: string): string {
  return SHORT_NAMES.includes(name) ? name.toUpperCase() : formatName(name);
}

function parseNumber(setting: Setting, text: string, whole: boolean): number {
  const value = Number(text);
  if (text === '' || !Number.isFinite(value)) throw new BadSetting(`Enter a ${whole ? 'whole ' : ''}number.`);
  if (whole && !Number.isInteger(value)) throw new BadSetting(`Enter a whole number, such as ${Math.round(value)}.`);
  const { least, above, most, below } = setting.bounds;
  const fits =
    (least === undefined || value >= least) &&
    (above === undefined || value > above) &&
    (most === undefined || value <= most) &&
    (below === undefined || value < below);
  if (!fits) throw new BadSetting(`It must be ${describeBounds(setting)}.`);
  return value;
}
