/** The timelines of one episode as charts: what they draw, and how their values read. */
import type { EpisodeTimelines } from '@/client/schema.gen';
import type { Line } from '@/components/line-chart';
import { formatValue } from '@/lib/format';

/** One chart over the steps of an episode. */
export interface Timeline {
  readonly title: string;
  readonly lines: readonly Line[];
  readonly format: (value: number | null) => string;
}

/** The chart of what SLDR rewards, in which the worst moment is marked. */
export const Q_TITLE = 'q';

type Columns = Readonly<Record<string, readonly (number | null)[]>>;

/** The charts of an episode; those of which it has nothing are left out. */
export function timelinesOf(episode: EpisodeTimelines): Timeline[] {
  const { distance, angle, contact, rewards, values } = episode;
  const moments = episode.episode.length + 1;
  const isSldr = (name: string): boolean => name.startsWith('sldr/');
  const touches = Object.entries(contact).map(([name, column]) => [name, column.map(Number)] as const);
  const isTouched = touches.some(([, column]) => column.some((touch) => touch > 0));
  return [
    timeline(Q_TITLE, pick(rewards, isSldr), formatValue),
    timeline(
      'Task reward',
      pick(rewards, (name) => name === 'task'),
      formatValue,
    ),
    timeline(
      'Other rewards',
      pick(rewards, (name) => name !== 'task' && !isSldr(name)),
      formatValue,
    ),
    timeline('Q values', values, formatValue),
    timeline('Distance to the goal [m]', { distance }, formatValue),
    timeline('Angle from the goal [rad]', angle === null ? {} : { angle }, formatValue),
    timeline('Touched by the robot', isTouched ? Object.fromEntries(touches) : {}, formatTouch),
  ]
    .filter(({ lines }) => lines.length > 0)
    .map(({ lines, ...rest }) => ({ ...rest, lines: lines.map((line) => padded(line, moments)) }));
}

/** Moments, of which there is one more than steps, drawn over the steps that lead to them. */
export function momentsOf({ episode }: EpisodeTimelines): number[] {
  return Array.from({ length: episode.length + 1 }, (_, step) => step);
}

function timeline(title: string, columns: Columns, format: Timeline['format']): Timeline {
  const lines = Object.entries(columns).map(([label, raw]) => ({ label, raw, smoothed: raw }));
  return { title, lines, format };
}

/** A column over the steps has one value less than there are moments. */
function padded(line: Line, length: number): Line {
  const raw = Array.from({ length }, (_, at) => line.raw[at] ?? null);
  return { ...line, raw, smoothed: raw };
}

function pick(columns: Columns, wanted: (name: string) => boolean): Columns {
  return Object.fromEntries(Object.entries(columns).filter(([name]) => wanted(name)));
}

function formatTouch(value: number | null): string {
  if (value === null) return formatValue(value);
  return value === 1 ? 'yes' : value === 0 ? 'no' : '';
}
