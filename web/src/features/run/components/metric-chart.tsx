/** One chart: its curves, the legend that follows the cursor, and the table behind it. */
import { ActionIcon, useComputedColorScheme } from '@mantine/core';
import { useDisclosure } from '@mantine/hooks';
import { useCallback, useMemo, useState } from 'react';
import { Icon } from '@/components/icon';
import { LineChart } from '@/components/line-chart';
import { type Metrics, newestValue } from '@/lib/metrics';
import { lineStyle, type Scheme } from '@/lib/palette';
import { AXIS_NAMES, type ChartPoints, type ChartSpec, chartPoints, formatX, formatY, xSteps } from '../charts';
import type { Axis } from '../search';
import classes from './charts.module.css';
import { MetricTable } from './metric-table';

/** What all charts of a run share. */
export interface ChartView {
  readonly metrics: Metrics;
  readonly x: readonly number[];
  readonly axis: Axis;
  /** How much the curves are smoothed. */
  readonly weight: number;
  readonly marks: readonly { readonly x: number; readonly label: string }[];
  readonly range: readonly [number, number];
  readonly onZoom: (range: readonly [number, number] | null) => void;
}

export function MetricChart({ chart, view, height }: { chart: ChartSpec; view: ChartView; height: number }) {
  const { metrics, x, axis, weight, marks, range, onZoom } = view;
  const scheme: Scheme = useComputedColorScheme('light');
  const [point, setPoint] = useState<number | null>(null);
  const [isTable, { toggle }] = useDisclosure(false);
  const points = useMemo(() => chartPoints(metrics, x, chart, weight), [metrics, x, chart, weight]);
  const lines = useMemo(
    () =>
      chart.series.map(({ label }, at) => ({ label, raw: points.raw[at] ?? [], smoothed: points.smoothed[at] ?? [] })),
    [chart, points],
  );
  const showX = useCallback((value: number) => formatX(axis, value), [axis]);
  const showY = useCallback((value: number) => formatY(chart, value).replace('.0\u202f', '\u202f'), [chart]);
  const newest = chart.series.map(({ label }, at) => `${label} ${formatY(chart, newestValue(points.raw[at] ?? []))}`);
  const until = points.x.at(-1);
  const name = `${chart.title} over ${AXIS_NAMES[axis].toLowerCase()}`;
  return (
    <figure className={`card ${classes.chart}`} aria-label={chart.title}>
      <figcaption className={classes.caption}>
        <h3>{chart.title}</h3>
        <Legend chart={chart} points={points} point={point} axis={axis} scheme={scheme} />
        <ActionIcon
          variant={isTable ? 'light' : 'subtle'}
          color="gray"
          size="sm"
          onClick={toggle}
          aria-pressed={isTable}
          aria-label={`${chart.title} as a table`}
        >
          <Icon name="table" size={14} />
        </ActionIcon>
      </figcaption>
      {isTable ? (
        <MetricTable chart={chart} view={view} points={points} height={height} />
      ) : (
        <LineChart
          x={points.x}
          lines={lines}
          range={range}
          scheme={scheme}
          height={height}
          isShare={chart.isShare}
          isSmoothed={weight > 0}
          xSteps={xSteps(axis)}
          formatX={showX}
          formatY={showY}
          marks={marks}
          onPoint={setPoint}
          onZoom={onZoom}
          description={`${name}; newest: ${newest.join(', ')}${until === undefined ? '' : ` at ${formatX(axis, until)}`}.`}
        />
      )}
    </figure>
  );
}

interface LegendProps {
  chart: ChartSpec;
  points: ChartPoints;
  /** Where the cursor is; the newest values are shown when it is nowhere. */
  point: number | null;
  axis: Axis;
  scheme: Scheme;
}

function Legend({ chart, points, point, axis, scheme }: LegendProps) {
  const end = point === null ? points.x.length : point + 1;
  const place = point === null ? undefined : points.x[point];
  return (
    <span className={classes.legend} aria-hidden="true">
      {chart.series.map(({ metric, label }, at) => {
        const { color, dash } = lineStyle(at, scheme);
        return (
          <span key={metric} className={classes.key} title={metric}>
            <svg width="18" height="8" aria-hidden="true">
              <path d="M0 4h18" stroke={color} strokeWidth="2" strokeDasharray={dash.join(' ')} />
            </svg>
            {chart.series.length > 1 && label}
            <b className="number">{formatY(chart, newestValue((points.raw[at] ?? []).slice(0, end)))}</b>
          </span>
        );
      })}
      {place !== undefined && (
        <span className="faint number">
          {AXIS_NAMES[axis].toLowerCase()} {formatX(axis, place)}
        </span>
      )}
    </span>
  );
}
