/** The attempts of the run: where each trained, from where on the curve, and how it ended. */
import { useQuery } from '@tanstack/react-query';
import { formatDuration, formatMoment, formatName, NOTHING, secondsBetween } from '@/lib/format';
import { useNow } from '@/lib/use-now';
import { attemptsQuery } from '../api/run-records';
import classes from './run.module.css';

export function Attempts({ runId }: { runId: string }) {
  const { data } = useQuery(attemptsQuery(runId));
  const now = useNow();
  if (data === undefined || data.attempts.length === 0) return null;
  return (
    <section className={classes.part}>
      <h2>Attempts</h2>
      <div className={`card ${classes.tableFrame}`}>
        <table className={classes.table} aria-label="Attempts">
          <thead>
            <tr>
              <th scope="col">Attempt</th>
              <th scope="col">Host</th>
              <th scope="col">Worker</th>
              <th scope="col">Started</th>
              <th scope="col">Lasted</th>
              <th scope="col" title="The first cycle that it logged; from there on it replaces earlier attempts">
                From cycle
              </th>
              <th scope="col">Ended</th>
              <th scope="col">Why</th>
            </tr>
          </thead>
          <tbody>
            {data.attempts.map((attempt) => (
              <tr key={attempt.attempt}>
                <th scope="row" className="number">
                  {attempt.attempt}
                </th>
                <td>{attempt.host ?? NOTHING}</td>
                <td className="mono faint">{attempt.worker_id}</td>
                <td className="number faint">
                  <time dateTime={attempt.started_at}>{formatMoment(attempt.started_at)}</time>
                </td>
                <td className="number">
                  {formatDuration(secondsBetween(attempt.started_at, attempt.ended_at ?? now))}
                </td>
                <td className="number">{attempt.first_cycle ?? NOTHING}</td>
                <td>{attempt.outcome === null ? 'still running' : formatName(attempt.outcome)}</td>
                <td className={classes.detail}>{attempt.reason}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}
