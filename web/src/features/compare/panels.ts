/** From the server's answer to what a panel draws and says. */
import type { Group, GroupCurve, Panel } from '@/client/schema.gen';
import { type Curve, extentOf, type SeedCurve } from '@/lib/curves';
import { groupStyle, type Scheme } from '@/lib/palette';
import { smooth } from '@/lib/smoothing';
import type { Range } from '@/lib/zoom';

/** A little air above and below what is drawn, as a share of it. */
const MARGIN = 0.06;

/** The y axis of shares: both ends can be seen. */
const SHARE_RANGE: Range = [-0.02, 1.02];

/**
 * The curves of one task.
 * @param weight how much they are smoothed
 */
export function panelCurves(panel: Panel, groups: readonly Group[], weight: number, scheme: Scheme): Curve[] {
  const known = new Map(groups.map((group) => [group.key, group]));
  return panel.curves.flatMap((curve) => {
    const group = known.get(curve.group);
    return group === undefined ? [] : [toCurve(curve, group, weight, scheme)];
  });
}

function toCurve(curve: GroupCurve, group: Group, weight: number, scheme: Scheme): Curve {
  const spacing = spacingOf(curve);
  const smoothed = (x: readonly number[], y: readonly (number | null)[]) =>
    smooth(
      y,
      x.map((place) => place / spacing),
      weight,
    );
  const seeds = curve.members.flatMap(({ run_id, seed, x, y }): SeedCurve[] =>
    x === null || y === null ? [] : [{ runId: run_id, seed, x, y: smoothed(x, y), raw: y }],
  );
  return {
    key: group.key,
    label: group.label,
    style: groupStyle(group, scheme),
    x: curve.x,
    centre: smoothed(curve.x, curve.centre),
    raw: curve.centre,
    low: smoothed(curve.x, curve.low),
    high: smoothed(curve.x, curve.high),
    n: curve.n_at,
    seeds,
    losses: curve.losses.flatMap(({ x, y, after }) => (y === null ? [] : [{ x, y, n: after }])),
  };
}

/** How far apart a run logs, so that smoothing means the same on every axis. */
function spacingOf({ x, members }: GroupCurve): number {
  const width = (x.at(-1) ?? 0) - (x[0] ?? 0);
  const most = Math.max(...members.map(({ points }) => points), 2);
  return width > 0 ? width / (most - 1) : 1;
}

/** What the curves of a panel are made of: with other runs, or others of them drawn, its y axis starts afresh. */
export function sourcesOf(panel: Panel): string {
  const sources = panel.curves.map(({ group, holds, members }) =>
    [group, holds, ...members.map(({ run_id, x }) => `${run_id} ${x !== null}`)].join(),
  );
  return sources.sort().join('\n');
}

/** All that there is of the x axis, in all panels. */
export function wholeOf(panels: readonly Panel[], isLog: boolean): Range {
  let first = Number.POSITIVE_INFINITY;
  let last = Number.NEGATIVE_INFINITY;
  for (const { curves } of panels) {
    for (const { x, members } of curves) {
      for (const places of [x, ...members.map((member) => member.x ?? [])]) {
        const start = places.find((place) => !isLog || place > 0);
        if (start !== undefined) first = Math.min(first, start);
        last = Math.max(last, places.at(-1) ?? last);
      }
    }
  }
  if (first > last) return isLog ? [1, 10] : [0, 1];
  if (isLog) return first < last ? [first, last] : [first, first * 10];
  return [0, last > 0 ? last : 1];
}

/** What the y axis has to hold. */
export function yExtent(curves: readonly Curve[], window: Range, isShare: boolean, isLog: boolean): Range | null {
  if (isShare && !isLog) return SHARE_RANGE;
  const extent = extentOf(curves, window, isLog);
  if (extent === null) return null;
  const [low, high] = extent;
  if (isLog) return low < high ? [low / 1.15, high * 1.15] : [low / 2, high * 2];
  const margin = (high - low) * MARGIN || Math.abs(high) * 0.1 || 1;
  // A curve that never falls below zero is drawn from zero when it comes near it.
  return [low >= 0 && low - margin < (high - low) * 0.5 ? 0 : low - margin, high + margin];
}

/** What a panel shows, in words. */
export interface PanelWords {
  /** What most curves are; all of it if that is short. */
  first: string;
  /** Each kind of curve that is otherwise. */
  others: string[];
  /** How many curves those are. */
  otherCurves: number;
}

/** As many letters as stand in two lines above a panel, so that curves side by side begin at nearly the same height. */
const SHORT_WORDS = 120;

/** What most curves of a panel are, then those that are otherwise; all by name where no two are alike. */
export function panelWords(panel: Panel, groups: readonly Group[]): PanelWords {
  const labels = new Map(groups.map(({ key, label }) => [key, label]));
  const kinds = new Map<string, string[]>();
  for (const { group, legend } of panel.curves) {
    kinds.set(legend, [...(kinds.get(legend) ?? []), labels.get(group) ?? group]);
  }
  const [most, ...rest] = [...kinds].sort((one, other) => other[1].length - one[1].length);
  if (most === undefined) return { first: '', others: [], otherCurves: 0 };
  const named = ([legend, names]: [string, string[]]) => `${names.join(', ')}: ${legend}`;
  const first = rest.length === 0 || most[1].length > 1 ? most[0] : named(most);
  const others = rest.map(named);
  const all = [first, ...others].join('; ');
  if (all.length <= SHORT_WORDS) return { first: all, others: [], otherCurves: 0 };
  return { first, others, otherCurves: panel.curves.length - most[1].length };
}
