/** What all panels of the page share: how their curves are looked at, and what the mouse does to all of them. */
import type { CurveComparison, Group, Panel } from '@/client/schema.gen';
import type { Axis } from '@/lib/axes';
import type { Emphasis } from '@/lib/curves';
import { formatShare, formatValue } from '@/lib/format';
import type { Scheme } from '@/lib/palette';
import type { Range } from '@/lib/zoom';
import { wholeOf } from './panels';
import type { CompareSearch } from './search';

export interface PanelView {
  readonly groups: CurveComparison['groups'];
  readonly metric: string;
  /** The metric in words. */
  readonly metricName: string;
  /** What is made of the seeds, in words. */
  readonly statistic: string;
  readonly axis: Axis;
  readonly scheme: Scheme;
  readonly weight: number;
  readonly isLogX: boolean;
  readonly isLogY: boolean;
  readonly isShare: boolean;
  /** What is shown of the x axis, and all there is of it. */
  readonly range: Range;
  readonly whole: Range;
  readonly emphasis: Emphasis | null;
  readonly onZoom: (range: Range | null) => void;
  readonly onNear: (emphasis: Emphasis | null) => void;
  readonly onPick: (emphasis: Emphasis) => void;
}

/** What is shown of the x axis: the part in the address, as far as there is anything, or all of it. */
export function windowOf({ from, to, logx }: CompareSearch, panels: readonly Panel[]): { range: Range; whole: Range } {
  const whole = wholeOf(panels, logx === 'yes');
  if (from === undefined || to === undefined) return { range: whole, whole };
  const start = logx === 'yes' && from <= 0 ? whole[0] : from;
  return { range: start < to ? [start, to] : whole, whole };
}

/** What stands out: what the mouse is near, else the pinned group; a group that is not there fades no other. */
export function standingOut(groups: readonly Group[], near: Emphasis | null, pin: string | undefined): Emphasis | null {
  const isThere = (key: string | undefined): boolean => groups.some((group) => group.key === key);
  if (near !== null && isThere(near.key)) return near;
  return pin !== undefined && isThere(pin) ? { key: pin } : null;
}

/** A value of the metric as text. */
export function formatY(isShare: boolean, value: number | null | undefined): string {
  return isShare ? formatShare(value, 1) : formatValue(value);
}

/** A value of the metric at a tick. */
export function formatTick(isShare: boolean, value: number): string {
  return formatY(isShare, value).replace('.0\u202f', '\u202f');
}
