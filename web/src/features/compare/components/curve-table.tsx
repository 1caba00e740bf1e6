/** The numbers that a panel draws, and the runs that they come from. */

import type { Panel } from '@/client/schema.gen';
import { AnchorLink } from '@/components/anchor-link';
import { NumberTable } from '@/components/number-table';
import { AXIS_NAMES, formatPlace } from '@/lib/axes';
import { type Curve, placesOf, rowAt } from '@/lib/curves';
import { NOTHING } from '@/lib/format';
import { formatY, type PanelView } from '../view';
import classes from './panels.module.css';

interface Props {
  panel: Panel;
  curves: readonly Curve[];
  view: PanelView;
  height: number;
}

interface Column {
  readonly title: string;
  readonly textAt: (place: number) => string;
}

export function CurveTable({ panel, curves, view, height }: Props) {
  const { axis, isShare, metricName, groups } = view;
  const columns = curves.flatMap((curve) => columnsOf(curve, isShare));
  const labels = new Map(groups.map(({ key, label }) => [key, label]));
  return (
    <div className={classes.tables}>
      <NumberTable
        name={`${panel.task}: ${metricName}`}
        columns={[AXIS_NAMES[axis], ...columns.map(({ title }) => title)]}
        rows={placesOf(curves).map((place) => [
          formatPlace(axis, place),
          ...columns.map(({ textAt }) => textAt(place)),
        ])}
        height={height}
      />
      <p className={classes.members}>
        {panel.curves.map(({ group, members }) => (
          <span key={group}>
            {labels.get(group) ?? group}:{' '}
            {members.map(({ run_id, seed }) => (
              <AnchorLink key={run_id} to="/runs/$runId" params={{ runId: run_id }} fz={12}>
                seed {seed}
              </AnchorLink>
            ))}
          </span>
        ))}
      </p>
    </div>
  );
}

/** Columns of a group: its centre, its band and how many seeds there are; or each seed. */
function columnsOf({ label, x, raw, low, high, n, seeds }: Curve, isShare: boolean): Column[] {
  const text = (places: readonly number[], values: readonly (number | null)[], place: number): string => {
    const row = rowAt(places, place);
    // Only the places where a curve has a point are numbers of it; between them it is drawn, not known.
    return places[row] === place ? formatY(isShare, values[row]) : NOTHING;
  };
  const own = seeds.map((seed) => ({
    title: `${label}, seed ${seed.seed}`,
    textAt: (place: number) => text(seed.x, seed.raw, place),
  }));
  if (raw.length === 0) return own;
  return [
    { title: label, textAt: (place) => text(x, raw, place) },
    { title: `${label}, low`, textAt: (place) => text(x, low, place) },
    { title: `${label}, high`, textAt: (place) => text(x, high, place) },
    { title: `${label}, n`, textAt: (place) => (x[rowAt(x, place)] === place ? String(n[rowAt(x, place)]) : NOTHING) },
    ...own,
  ];
}
