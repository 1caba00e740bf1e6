/** What the curves of a panel are at the cursor, the highest first. */
import { useState } from 'react';
import { LineSwatch } from '@/components/line-swatch';
import { AXIS_NAMES, formatX } from '@/lib/axes';
import { type Curve, rowAt, type Values } from '@/lib/curves';
import type { LineStyle } from '@/lib/palette';
import { formatY, type PanelView } from '../view';
import classes from './panels.module.css';

/** One line of it: a group, or a seed. */
export interface Reading {
  readonly key: string;
  readonly label: string;
  readonly style: LineStyle;
  readonly value: number;
  readonly band: readonly [number, number] | null;
  readonly n: number;
}

/** As many lines as fit into a panel. */
const MOST_LINES = 9;

/** What the curves are at a place of the x axis, the highest first. */
export function readingsAt(curves: readonly Curve[], place: number): Reading[] {
  const found = curves.flatMap((curve): Reading[] => {
    const { key, label, style, x, centre, low, high, n, seeds } = curve;
    if (centre.length === 0) {
      return seeds.flatMap((seed) => {
        const value = valueAt(seed.x, seed.y, place);
        return value === null
          ? []
          : [{ key: seed.runId, label: `${label}, seed ${seed.seed}`, style, value, band: null, n: 1 }];
      });
    }
    const value = valueAt(x, centre, place);
    if (value === null) return [];
    const [bottom, top] = [valueAt(x, low, place), valueAt(x, high, place)];
    const band = bottom === null || top === null ? null : ([bottom, top] as const);
    return [{ key, label, style, value, band, n: n[rowAt(x, place)] ?? 0 }];
  });
  return found.sort((one, other) => other.value - one.value);
}

function valueAt(x: readonly number[], column: Values, place: number): number | null {
  return column[rowAt(x, place)] ?? null;
}

interface Props {
  curves: readonly Curve[];
  place: number;
  view: PanelView;
}

export function Readout({ curves, place, view: { axis, isShare, emphasis, range } }: Props) {
  const readings = readingsAt(curves, place);
  const isLeft = place > (range[0] + range[1]) / 2;
  const [box, setBox] = useState<HTMLDivElement | null>(null);
  // It stands beside the plot, so that it covers nothing of it: below, or above where the screen ends.
  const plot = box?.parentElement?.getBoundingClientRect();
  const isAbove = plot !== undefined && plot.bottom + (box?.offsetHeight ?? 0) > window.innerHeight;
  return (
    <div
      ref={setBox}
      className={classes.readout}
      data-left={isLeft || undefined}
      data-above={isAbove || undefined}
      aria-hidden="true"
    >
      <p className="faint number">
        {AXIS_NAMES[axis].toLowerCase()} {formatX(axis, place)}
      </p>
      {readings.slice(0, MOST_LINES).map(({ key, label, style, value, band, n }) => (
        <p key={key} data-strong={emphasis?.key === key || emphasis?.runId === key || undefined}>
          <LineSwatch style={style} width={16} />
          <span className={classes.readoutLabel}>{label}</span>
          <b className="number">{formatY(isShare, value)}</b>
          {band && (
            <span className="faint number">
              {formatY(isShare, band[0])} to {formatY(isShare, band[1])}
            </span>
          )}
          <span className="faint number">n {n}</span>
        </p>
      ))}
      {readings.length > MOST_LINES && <p className="faint">and {readings.length - MOST_LINES} more</p>}
    </div>
  );
}

/** The same in one sentence, for those who cannot see it. */
export function describeReadings(curves: readonly Curve[], place: number, { axis, isShare }: PanelView): string {
  const words = readingsAt(curves, place).map(
    ({ label, value, band, n }) =>
      `${label} ${formatY(isShare, value)}${band ? ` (${formatY(isShare, band[0])} to ${formatY(isShare, band[1])})` : ''}, n ${n}`,
  );
  return `${AXIS_NAMES[axis].toLowerCase()} ${formatX(axis, place)}: ${words.join('; ') || 'no curve'}`;
}
