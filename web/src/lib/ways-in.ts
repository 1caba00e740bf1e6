/** What the page would launch, as a command to type and as a script to run. */
import type { Launch, StudySpec } from '@/client/schema.gen';

type Nested = Readonly<Record<string, unknown>>;

/** The command that queues the same runs. */
export function launchCommand(launch: Launch, server: string): string {
  return command([
    ...[`--server ${quoted(server)}`, `--task ${quoted(launch.task)}`, `--method ${quoted(launch.method)}`],
    ...(launch.phase === 'locomotion' ? ['--phase locomotion'] : []),
    ...[`--seeds ${seedWords(launch.seeds)}`, `--preset ${quoted(launch.preset)}`],
    ...(launch.locomotion === 'zoo' ? [] : [`--locomotion ${quoted(launch.locomotion)}`]),
    ...settingOptions(launch.overrides ?? {}),
  ]);
}

/** The script that queues the same runs. */
export function launchScript(launch: Launch, server: string): string {
  return script(
    server,
    'runs = client.runs.launch',
    [
      ['task', launch.task],
      ['method', launch.method],
      ['seeds', launch.seeds],
      ['preset', launch.preset],
      ...(launch.phase === 'locomotion' ? [['phase', launch.phase] as const] : []),
      ...(launch.locomotion === 'zoo' ? [] : [['locomotion', launch.locomotion] as const]),
      ...settingWords(launch.overrides ?? {}),
    ],
    ['for run in runs:', '    print(run.id, run.state)', '# client.runs.wait(runs) waits for their end.'],
  );
}

/** The command that makes the same study. */
export function studyCommand(name: string, spec: StudySpec, server: string): string {
  return command([
    ...[`--server ${quoted(server)}`, `--study ${quoted(name)}`],
    ...spec.tasks.map((task) => `--task ${quoted(task)}`),
    ...spec.methods.map((method) => `--method ${quoted(method)}`),
    ...[`--seeds ${seedWords(spec.seeds)}`, `--preset ${quoted(spec.preset)}`],
    ...(spec.locomotion === 'zoo' ? [] : [`--locomotion ${quoted(spec.locomotion)}`]),
    ...settingOptions(spec.overrides ?? {}),
    ...(spec.variants ?? []).map(
      (variant) => `--variant ${quoted(variant.name)} ${quoted(JSON.stringify(variant.overrides))}`,
    ),
  ]);
}

/** The script that makes the same study. */
export function studyScript(name: string, spec: StudySpec, server: string): string {
  const variants = Object.fromEntries((spec.variants ?? []).map((variant) => [variant.name, variant.overrides]));
  return script(
    server,
    'study = client.studies.launch',
    [
      ['name', name],
      ['tasks', spec.tasks],
      ['methods', spec.methods],
      ['seeds', spec.seeds],
      ['preset', spec.preset],
      ...settingWords(spec.overrides ?? {}),
      ...(spec.locomotion === 'zoo' ? [] : [['locomotion', spec.locomotion] as const]),
      ...(Object.keys(variants).length > 0 ? [['variants', variants] as const] : []),
    ],
    ['print(study.study_id, study.queued)', '# client.studies.wait(study) waits for its end.'],
  );
}

function command(options: readonly string[]): string {
  return `${['sldr launch', ...options].join(' \\\n  ')}\n`;
}

function script(
  server: string,
  call: string,
  words: readonly (readonly [string, unknown])[],
  after: readonly string[],
): string {
  const lines = [
    `with Client(${literal(server)}) as client:`,
    `    ${call}(`,
    ...words.map(([name, value]) => `        ${name}=${literal(value)},`),
    '    )',
    ...after.map((line) => `    ${line}`),
  ];
  return `from backend.client import Client\n\n${lines.join('\n')}\n`;
}

/** Seeds that follow each other as a range, others one by one. */
function seedWords(seeds: readonly number[]): string {
  const [first = 0] = seeds;
  const isRange = seeds.length > 1 && seeds.every((seed, place) => seed === first + place);
  return isRange ? `${first}-${seeds.at(-1)}` : seeds.join(',');
}

function settingOptions(overrides: Nested): string[] {
  return leaves(overrides).map(([path, value]) => `--set ${quoted(`${path}=${settingWord(value)}`)}`);
}

function settingWords(overrides: Nested): (readonly [string, unknown])[] {
  return Object.keys(overrides).length > 0 ? [['settings', overrides]] : [];
}

/** A value as the command line reads it: JSON, or text where that means the same. */
function settingWord(value: unknown): string {
  if (typeof value === 'string' && /^[A-Za-z_][\w./-]*$/.test(value) && !JSON_WORDS.has(value)) return value;
  return JSON.stringify(value);
}

/** Words that would be read as something else than text. */
const JSON_WORDS: ReadonlySet<string> = new Set(['true', 'false', 'null', 'NaN', 'Infinity']);

function leaves(nested: Nested, path = ''): [string, unknown][] {
  return Object.entries(nested).flatMap(([name, value]): [string, unknown][] =>
    typeof value === 'object' && value !== null && !Array.isArray(value)
      ? leaves(value as Nested, `${path}${name}.`)
      : [[`${path}${name}`, value]],
  );
}

/** A word as a POSIX shell takes it. */
function quoted(word: string): string {
  return /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", `'\\''`)}'`;
}

/** A JSON value as Python writes it. */
function literal(value: unknown): string {
  if (value === null || value === undefined) return 'None';
  if (typeof value === 'boolean') return value ? 'True' : 'False';
  if (Array.isArray(value)) return `[${value.map(literal).join(', ')}]`;
  if (typeof value !== 'object') return JSON.stringify(value);
  return `{${Object.entries(value)
    .map(([key, part]) => `${JSON.stringify(key)}: ${literal(part)}`)
    .join(', ')}}`;
}
