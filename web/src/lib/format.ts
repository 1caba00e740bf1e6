/** Numbers, times and sizes as text, the same everywhere on the page. */

/** What stands where there is no number (yet). */
export const NOTHING = '–';

const MINUTE = 60; // [s]
const HOUR = 60 * MINUTE; // [s]
const DAY = 24 * HOUR; // [s]

/** Units of a span of time, the largest first. */
const UNITS = [
  { name: 'd', size: DAY },
  { name: 'h', size: HOUR },
  { name: 'm', size: MINUTE },
  { name: 's', size: 1 },
] as const;

/** From so many of a unit on, an estimate tells nothing smaller. */
const ESTIMATED = 10;

/** Figures of a number that is written short. */
const FIGURES = 3;

type Maybe = number | null | undefined;

function isNumber(value: Maybe): value is number {
  return typeof value === 'number' && Number.isFinite(value);
}

/** A whole number with narrow spaces: `57 000`. */
export function formatCount(value: Maybe): string {
  if (!isNumber(value)) return NOTHING;
  return Math.round(value)
    .toString()
    .replace(/\B(?=(\d{3})+(?!\d))/g, '\u202f');
}

/**
 * A number in three figures with a suffix: `1.23M`, `57k`, `840`.
 * @param step numbers so far apart read differently: they have more figures where that takes more
 */
export function formatShort(value: Maybe, step?: number): string {
  if (!isNumber(value)) return NOTHING;
  const size = Math.abs(value);
  const count = step ? Math.max(FIGURES, powerOf(size) - powerOf(step) + 1) : FIGURES;
  if (size >= 999_500_000) return `${figures(value / 1e9, count)}G`;
  if (size >= 999_500) return `${figures(value / 1e6, count)}M`;
  if (size >= 999.5) return `${figures(value / 1e3, count)}k`;
  return figures(value, count);
}

/** A measured value in four figures, in powers of ten when very small or large. */
export function formatValue(value: Maybe): string {
  if (!isNumber(value)) return NOTHING;
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(2).replace('e+', 'e');
  return String(Number(value.toPrecision(4)));
}

/** A share from 0 to 1 in percent: `93 %`, `93.4 %` with one digit. */
export function formatShare(value: Maybe, digits = 0): string {
  if (!isNumber(value)) return NOTHING;
  return `${(value * 100).toFixed(digits)}\u202f%`;
}

/** A rate with its unit: `3.12k/s`. */
export function formatRate(value: Maybe): string {
  return isNumber(value) ? `${formatShort(value)}/s` : NOTHING;
}

/**
 * A span of time in its two largest units: `7s`, `3m 20s`, `2h 5m`, `3d 4h`.
 * @param step spans so far apart read differently: they have more units where that takes more
 */
export function formatDuration(seconds: Maybe, step = DAY): string {
  if (!isNumber(seconds)) return NOTHING;
  let rest = Math.max(0, Math.round(seconds));
  const largest = UNITS.findIndex(({ size }) => rest >= size);
  if (largest === -1) return '0s';
  const smallest = Math.max(
    largest + 1,
    UNITS.findIndex(({ size }) => size <= step),
  );
  const parts = UNITS.slice(largest, smallest + 1).map(({ name, size }) => {
    const count = Math.floor(rest / size);
    rest %= size;
    return count === 0 ? '' : `${count}${name}`;
  });
  return parts.filter(Boolean).join(' ');
}

/** A span that is only guessed, without what nobody can know: `3m 20s`, `42m`, `7h 22m`, `13h`. */
export function formatEstimate(seconds: Maybe): string {
  if (!isNumber(seconds)) return NOTHING;
  const told = UNITS.find(({ size }) => seconds >= ESTIMATED * size)?.size ?? 1;
  return formatDuration(Math.round(seconds / told) * told);
}

/** How long ago a moment was: `just now`, `12 s ago`, `3 h ago`. */
export function formatAgo(seconds: Maybe): string {
  if (!isNumber(seconds)) return NOTHING;
  const whole = Math.max(0, Math.round(seconds));
  if (whole < 2) return 'just now';
  if (whole < MINUTE) return `${whole} s ago`;
  if (whole < HOUR) return `${Math.floor(whole / MINUTE)} min ago`;
  if (whole < DAY) return `${Math.floor(whole / HOUR)} h ago`;
  return `${Math.floor(whole / DAY)} d ago`;
}

/** About how long until a moment: `now`, `in 12s`, `in 42m`, `in 2h 5m`. */
export function formatUntil(seconds: Maybe): string {
  if (!isNumber(seconds)) return NOTHING;
  return seconds < 1 ? 'now' : `in ${formatEstimate(seconds)}`;
}

/** A moment as local date and time, to the second: `2026-11-22 17:04:09`. */
export function formatMoment(iso: string | null | undefined): string {
  if (!iso) return NOTHING;
  const moment = new Date(iso);
  const two = (part: number): string => String(part).padStart(2, '0');
  const day = `${moment.getFullYear()}-${two(moment.getMonth() + 1)}-${two(moment.getDate())}`;
  return `${day} ${two(moment.getHours())}:${two(moment.getMinutes())}:${two(moment.getSeconds())}`;
}

/** A file size in bytes: `12.3 MB`. */
export function formatSize(bytes: Maybe): string {
  if (!isNumber(bytes)) return NOTHING;
  if (bytes < 1000) return `${bytes} B`;
  if (bytes < 999_500) return `${figures(bytes / 1e3)} kB`;
  if (bytes < 999_500_000) return `${figures(bytes / 1e6)} MB`;
  return `${figures(bytes / 1e9)} GB`;
}

/** A name made for programs as words: `updates_per_cycle` to `Updates per cycle`. */
export function formatName(name: string): string {
  const words = name.replaceAll(/[_-]+/g, ' ').trim();
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** `1 run`, `2 runs`. */
export function formatPlural(count: number, noun: string): string {
  return `${formatCount(count)} ${noun}${count === 1 ? '' : 's'}`;
}

/** Seconds from one ISO moment to another (or to a time in ms); null where one is missing. */
export function secondsBetween(
  start: string | null | undefined,
  end: string | number | null | undefined,
): number | null {
  if (!start || end === null || end === undefined) return null;
  const until = typeof end === 'number' ? end : Date.parse(end);
  return (until - Date.parse(start)) / 1000;
}

function figures(value: number, count = FIGURES): string {
  return String(Number(value.toPrecision(count)));
}

/** Of the first digit of a number, as a power of ten. */
function powerOf(size: number): number {
  return size === 0 ? 0 : Math.floor(Math.log10(size));
}
