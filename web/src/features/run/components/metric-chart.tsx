/** One chart: its curves, the legend that follows the cursor, and the table behind it. */
import { ActionIcon, useComputedColorScheme } from '@mantine/core';
import { useDisclosure } from '@mantine/hooks';
import { useCallback, useMemo, useState } from 'react';
import type { MetricBatch } from '@/client/schema.gen';
import { Icon } from '@/components/icon';
import { LineChart } from '@/components/line-chart';
import type { Mark } from '@/components/line-chart-marks';
import { AXIS_NAMES, formatX, xSteps } from '@/lib/axes';
import { type Metrics, newestValue } from '@/lib/metrics';
import { lineStyle, type Scheme } from '@/lib/palette';
import type { Range } from '@/lib/zoom';
import { chartGhosts } from '../attempt-marks';
import { type ChartPoints, type ChartSpec, chartPoints, formatY } from '../charts';
import type { Axis } from '../search';
import classes from './charts.module.css';
import { MetricTable } from './metric-table';

/** What all charts of a run share. */
export interface ChartView {
  readonly metrics: Metrics;
  readonly x: readonly number[];
  /** Where the points of a stretch lie on the x axis. */
  readonly placeOf: (part: MetricBatch) => readonly number[];
  readonly axis: Axis;
  /** How much the curves are smoothed. */
  readonly weight: number;
  readonly marks: readonly Mark[];
  /** What is shown of the x axis, and all there is of it. */
  readonly range: Range;
  readonly whole: Range;
  readonly onZoom: (range: Range | null) => void;
}

export function MetricChart({ chart, view, height }: { chart: ChartSpec; view: ChartView; height: number }) {
  const { metrics, x, placeOf, axis, weight, marks, range, whole, onZoom } = view;
  const scheme: Scheme = useComputedColorScheme('light');
  const [point, setPoint] = useState<number | null>(null);
  const [isTable, { toggle }] = useDisclosure(false);
  const points = useMemo(() => chartPoints(metrics, x, chart, weight), [metrics, x, chart, weight]);
  const ghosts = useMemo(() => chartGhosts(metrics, chart, placeOf), [metrics, chart, placeOf]);
  const lines = useMemo(
    () =>
      chart.series.map(({ label }, at) => ({ label, raw: points.raw[at] ?? [], smoothed: points.smoothed[at] ?? [] })),
    [chart, points],
  );
  const showX = useCallback((value: number, step?: number) => formatX(axis, value, step), [axis]);
  const showY = useCallback((value: number) => formatY(chart, value).replace('.0\u202f', '\u202f'), [chart]);
  const valuesAt = (end: number): string =>
    chart.series
      .map(({ label }, at) => `${label} ${formatY(chart, newestValue((points.raw[at] ?? []).slice(0, end + 1)))}`)
      .join(', ');
  const placeAt = (at: number): string => `${AXIS_NAMES[axis].toLowerCase()} ${formatX(axis, points.x[at] ?? 0)}`;
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
          whole={whole}
          scheme={scheme}
          height={height}
          isShare={chart.isShare}
          isSmoothed={weight > 0}
          xSteps={xSteps(axis)}
          formatX={showX}
          formatY={showY}
          marks={marks}
          ghosts={ghosts}
          onPoint={setPoint}
          onZoom={onZoom}
          description={name}
          describePoint={(at) => `${placeAt(at)}: ${valuesAt(at)}`}
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
