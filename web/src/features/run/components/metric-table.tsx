/** The numbers behind a chart, newest first. */
import { formatCount, formatDuration, NOTHING } from '@/lib/format';
import { type ChartPoints, type ChartSpec, formatY } from '../charts';
import classes from './charts.module.css';
import type { ChartView } from './metric-chart';

/** As many rows as a page takes easily. */
const MOST_ROWS = 500;

interface Props {
  chart: ChartSpec;
  view: ChartView;
  points: ChartPoints;
  height: number;
}

export function MetricTable({ chart, view, points, height }: Props) {
  const { metrics } = view;
  const rows = points.rows
    .map((row, at) => ({ row, at }))
    .slice(-MOST_ROWS)
    .reverse();
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
    <section className={classes.tableFrame} style={{ height }} tabIndex={0} aria-label={`${chart.title}, numbers`}>
      <table className={classes.table} aria-label={chart.title}>
        <thead>
          <tr>
            {['Epoch', 'Env steps', 'Updates', 'Wall time', ...chart.series.map(({ label }) => label)].map((name) => (
              <th key={name} scope="col">
                {name}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {rows.map(({ row, at }) => (
            <tr key={row}>
              <td>{metrics.epoch[row] ?? NOTHING}</td>
              <td>{formatCount(metrics.env_steps[row])}</td>
              <td>{formatCount(metrics.updates[row])}</td>
              <td>{formatDuration(metrics.wall_seconds[row])}</td>
              {chart.series.map(({ metric }, line) => (
                <td key={metric}>{formatY(chart, points.raw[line]?.[at] ?? null)}</td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
      {points.rows.length > MOST_ROWS && (
        <p className="faint">
          The newest {MOST_ROWS} of {formatCount(points.rows.length)} rows.
        </p>
      )}
    </section>
  );
}
