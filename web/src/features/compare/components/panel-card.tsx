/** One task: the curves of its methods, what they are, and the table behind them. */
import { ActionIcon } from '@mantine/core';
import { memo, useCallback, useMemo, useState } from 'react';
import type { Panel } from '@/client/schema.gen';
import { CurveChart } from '@/components/curve-chart';
import { Icon } from '@/components/icon';
import { AXIS_NAMES, formatX, xSteps } from '@/lib/axes';
import type { Curve } from '@/lib/curves';
import { formatPlural } from '@/lib/format';
import { useGrowing } from '@/lib/use-growing';
import { useSeen } from '@/lib/use-seen';
import { type PanelWords, panelCurves, panelWords, sourcesOf, yExtent } from '../panels';
import { formatTick, type PanelView } from '../view';
import { CurveTable } from './curve-table';
import classes from './panels.module.css';
import { describeReadings, Readout } from './readout';

interface Props {
  panel: Panel;
  view: PanelView;
  height: number;
  isTable: boolean;
  onTable: (task: string) => void;
}

export const PanelCard = memo(function PanelCard({ panel, view, height, isTable, onTable }: Props) {
  const { groups, weight, scheme, metricName, axis } = view;
  const [figure, isSeen] = useSeen<HTMLElement>();
  const curves = useMemo(() => panelCurves(panel, groups, weight, scheme), [panel, groups, weight, scheme]);
  const hasPoints = curves.some(({ x, seeds }) => x.length > 0 || seeds.some((seed) => seed.x.length > 0));
  return (
    <figure ref={figure} className={`card ${classes.panel}`} aria-label={panel.task}>
      <figcaption className={classes.caption}>
        <div className={classes.title}>
          <h3>{panel.task}</h3>
          <Words {...panelWords(panel, groups)} />
        </div>
        <ActionIcon
          variant={isTable ? 'light' : 'subtle'}
          color="gray"
          size="sm"
          onClick={() => onTable(panel.task)}
          aria-pressed={isTable}
          aria-label={`${panel.task} as a table`}
        >
          <Icon name="table" size={14} />
        </ActionIcon>
      </figcaption>
      {!hasPoints && (
        <p className={`faint ${classes.empty}`} style={{ minHeight: height }}>
          No run of {panel.task} has logged {metricName.toLowerCase()} over {AXIS_NAMES[axis].toLowerCase()} yet.
        </p>
      )}
      {hasPoints && isTable && <CurveTable panel={panel} curves={curves} view={view} height={height} />}
      {hasPoints && !isTable && (
        <div className={classes.plot} style={{ height }}>
          {isSeen && <Curves panel={panel} curves={curves} view={view} height={height} />}
        </div>
      )}
    </figure>
  );
});

function Words({ first, others, otherCurves }: PanelWords) {
  return (
    <>
      <span className="faint">{first}</span>
      {others.length > 0 && (
        <details className="faint">
          <summary>{formatPlural(otherCurves, 'curve')} of another kind</summary>
          {others.map((words) => (
            <p key={words}>{words}</p>
          ))}
        </details>
      )}
    </>
  );
}

interface CurvesProps {
  panel: Panel;
  curves: readonly Curve[];
  view: PanelView;
  height: number;
}

function Curves({ panel, curves, view, height }: CurvesProps) {
  const { axis, isShare, isLogX, isLogY, range, metric, metricName, statistic } = view;
  const [place, setPlace] = useState<number | null>(null);
  const extent = useMemo(() => yExtent(curves, range, isShare, isLogY), [curves, range, isShare, isLogY]);
  const sources = useMemo(() => sourcesOf(panel), [panel]);
  const end = view.range === view.whole ? '' : range[1];
  const look = [metric, statistic, axis, isLogY, view.weight, range[0], end, sources].join('\n');
  const yRange = useGrowing(extent, look) ?? [0, 1];
  const showX = useCallback((value: number, step?: number) => formatX(axis, value, step), [axis]);
  const showY = useCallback((value: number) => formatTick(isShare, value), [isShare]);
  return (
    <>
      <CurveChart
        {...view}
        curves={curves}
        height={height}
        isSmoothed={view.weight > 0}
        isLogX={isLogX}
        isLogY={isLogY}
        yRange={yRange}
        xSteps={xSteps(axis)}
        formatX={showX}
        formatY={showY}
        onPoint={(next, isHere) => setPlace(isHere ? next : null)}
        description={`${panel.task}: ${metricName.toLowerCase()} over ${AXIS_NAMES[axis].toLowerCase()}`}
        describePlace={(at) => describeReadings(curves, at, view)}
      />
      {place !== null && <Readout curves={curves} place={place} view={view} />}
    </>
  );
}
