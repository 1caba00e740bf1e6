/** The curves below a 3D view, as its session tells them, sorted into charts. */

export type TimelineColumn = readonly (number | null)[];

/** All curves of the episode that is shown, by `group/name`. */
export interface Timeline {
  readonly version: number;
  /** The last step that is known. */
  readonly known: number;
  readonly steps: number;
  readonly columns: Readonly<Record<string, TimelineColumn>>;
}

/** One curve of a chart. */
export interface TimelineCurve {
  readonly label: string;
  readonly values: TimelineColumn;
}

/** One chart. */
export interface TimelineChart {
  readonly group: string;
  readonly title: string;
  /** Written behind values. */
  readonly unit: string;
  readonly curves: readonly TimelineCurve[];
}

interface Group {
  readonly title: string;
  readonly unit: string;
  /** What the values are shown times. */
  readonly scale: number;
}

/** The charts there can be, from top to bottom. */
const GROUPS: Readonly<Record<string, Group>> = {
  q: { title: 'q, against the demonstration', unit: '', scale: 1 },
  reward: { title: 'Reward', unit: '', scale: 1 },
  value: { title: 'Q value', unit: '', scale: 1 },
  distance: { title: 'Distance', unit: 'cm', scale: 100 },
  angle: { title: 'Angle', unit: '°', scale: 180 / Math.PI },
  contact: { title: 'Contact', unit: '', scale: 1 },
};

/** Return the charts of a timeline; groups without curves have none. */
export function timelineCharts(timeline: Timeline): TimelineChart[] {
  return Object.entries(GROUPS).flatMap(([group, { title, unit, scale }]) => {
    const curves = Object.entries(timeline.columns)
      .filter(([name]) => name.startsWith(`${group}/`))
      .map(([name, column]) => ({
        label: name.slice(group.length + 1),
        values: scale === 1 ? column : column.map((value) => (value === null ? null : value * scale)),
      }));
    return curves.length > 0 ? [{ group, title, unit, curves }] : [];
  });
}

/** The step at which the robot's move departed most from what an object wanted; undefined without q. */
export function worstQStep(timeline: Timeline): number | undefined {
  let worst: { step: number; q: number } | undefined;
  for (const [name, column] of Object.entries(timeline.columns)) {
    if (!name.startsWith('q/')) continue;
    column.forEach((q, step) => {
      if (q !== null && (worst === undefined || q < worst.q || (q === worst.q && step < worst.step))) {
        worst = { step, q };
      }
    });
  }
  return worst?.step;
}

/** A value of a chart as text. */
export function formatTimelineValue(chart: TimelineChart, value: number | null | undefined): string {
  if (value === null || value === undefined) return '–';
  if (chart.group === 'contact') return value > 0 ? 'yes' : 'no';
  const digits = chart.unit === '' ? 3 : 1;
  return `${value.toFixed(digits)}${chart.unit && `\u202f${chart.unit}`}`;
}
