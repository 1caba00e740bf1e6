/** What the compare page shows, as it stands in the address: everything but the place of the mouse. */

import type { Axis } from '@/lib/axes';
import { MOST_SMOOTHING } from '@/lib/smoothing';

export const TABS = ['curves', 'best'] as const;
export type Tab = (typeof TABS)[number];

/** What the curves may be drawn over. */
export const AXES: readonly Axis[] = ['epoch', 'env_steps', 'episodes', 'updates', 'wall_seconds'];

/** What is made of the seeds of a group. */
export const STATISTICS = ['median', 'mean', 'iqm', 'seeds'] as const;
export type Statistic = (typeof STATISTICS)[number];

/** How sure an interval is, for those who choose. */
export const LEVELS = [0.8, 0.9, 0.95, 0.99] as const;
export const USUAL_LEVEL = 0.95;

/** What is counted until a test first reaches a success, and which success. */
export const EFFORTS = ['env_steps', 'wall_seconds'] as const;
export type Effort = (typeof EFFORTS)[number];
export const REACHED = [0.5, 0.8, 0.9] as const;
export const USUAL_REACHED = 0.8;

/** The metric shown unless another is asked for: the one that the methods are judged by. */
export const USUAL_METRIC = 'test/success_rate';

/** Ids and names of one value are parted by this. */
const PART = ',';

export interface CompareSearch {
  readonly tab?: Tab;
  /** Which runs: those of a study, or some by id, or all that pass the filters. */
  readonly study?: string;
  readonly runs?: string;
  readonly tasks?: string;
  readonly methods?: string;
  readonly phase?: 'locomotion' | 'manipulation';
  readonly preset?: string;
  readonly metric?: string;
  readonly x?: Axis;
  readonly statistic?: Statistic;
  readonly level?: number;
  readonly smooth?: number;
  readonly logx?: 'yes';
  readonly logy?: 'yes';
  /** Whether the seeds are drawn faintly behind their centre. */
  readonly seeds?: 'yes';
  /** Whether a run that is done counts no more behind its end; else its last value does. */
  readonly drop?: 'yes';
  /** Whether the mouse picks out single runs, instead of methods. */
  readonly hover?: 'run';
  /** The group that stands out until it is let go. */
  readonly pin?: string;
  /** The part of the x axis that is shown. */
  readonly from?: number;
  readonly to?: number;
  /** How efficiency is counted. */
  readonly effort?: Effort;
  readonly reached?: number;
  /** Tasks, and figures of best models, whose numbers are shown as a table. */
  readonly tables?: string;
}

/** Read the page's view from an address; what makes no sense is left out. */
export function readCompareSearch(raw: Record<string, unknown>): CompareSearch {
  const text = (key: string): string | undefined => {
    const value = raw[key];
    return value === undefined || value === null || value === '' ? undefined : String(value);
  };
  const isYes = (key: string): 'yes' | undefined => (raw[key] === 'yes' ? 'yes' : undefined);
  const number = (key: string): number | undefined => {
    const value = Number(text(key));
    return text(key) !== undefined && Number.isFinite(value) ? value : undefined;
  };
  const phase = text('phase');
  const smooth = number('smooth');
  const level = number('level');
  const [from, to] = [number('from'), number('to')];
  const isWindow = from !== undefined && to !== undefined && from < to;
  return {
    tab: TABS.find((tab) => tab === raw.tab),
    study: text('study'),
    runs: text('runs'),
    tasks: text('tasks'),
    methods: text('methods'),
    phase: phase === 'locomotion' || phase === 'manipulation' ? phase : undefined,
    preset: text('preset'),
    metric: text('metric'),
    x: AXES.find((axis) => axis === raw.x),
    statistic: STATISTICS.find((statistic) => statistic === raw.statistic),
    level: LEVELS.find((known) => known === level),
    smooth: smooth !== undefined && smooth > 0 && smooth <= MOST_SMOOTHING ? smooth : undefined,
    logx: isYes('logx'),
    logy: isYes('logy'),
    seeds: isYes('seeds'),
    drop: isYes('drop'),
    hover: raw.hover === 'run' ? 'run' : undefined,
    pin: text('pin'),
    from: isWindow ? from : undefined,
    to: isWindow ? to : undefined,
    effort: EFFORTS.find((effort) => effort === raw.effort),
    reached: REACHED.find((known) => known === number('reached')),
    tables: text('tables'),
  };
}

/** Which runs' configs are compared. */
export interface ConfigsSearch {
  readonly runs?: string;
}

export function readConfigsSearch(raw: Record<string, unknown>): ConfigsSearch {
  return { runs: readCompareSearch(raw).runs };
}

/** The parts of a value that names several things. */
export function partsOf(value: string | undefined): readonly string[] {
  return value === undefined ? [] : value.split(PART).filter((part) => part !== '');
}

/** Several things as one value; nothing where there is none. */
export function joined(parts: readonly string[]): string | undefined {
  return parts.length === 0 ? undefined : parts.join(PART);
}

/** A value with one part more, or without it if it was there. */
export function toggled(value: string | undefined, part: string): string | undefined {
  const parts = partsOf(value);
  return joined(parts.includes(part) ? parts.filter((other) => other !== part) : [...parts, part]);
}
