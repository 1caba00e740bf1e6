/** What happened to the run, oldest first. */
import { useQuery } from '@tanstack/react-query';
import { SentencePanel } from '@/components/sentence-panel';
import { StateBadge } from '@/components/state-badge';
import { sentence } from '@/lib/api';
import { formatMoment, formatName, NOTHING } from '@/lib/format';
import { eventsQuery } from '../api/run-records';
import classes from './run.module.css';

export function HistoryTab({ runId }: { runId: string }) {
  const { data, error } = useQuery(eventsQuery(runId));
  if (error && !data) {
    return (
      <SentencePanel urgent title="The history cannot be shown">
        {sentence(error)}
      </SentencePanel>
    );
  }
  return (
    <div className={`card ${classes.tableFrame}`}>
      <table className={classes.table} aria-label="History">
        <thead>
          <tr>
            <th scope="col">When</th>
            <th scope="col">What</th>
            <th scope="col">State</th>
            <th scope="col">Attempt</th>
            <th scope="col">Detail</th>
          </tr>
        </thead>
        <tbody>
          {data?.events.map(({ at, event, state, attempt, detail }) => (
            <tr key={`${at} ${event}`}>
              <td className="number faint">
                <time dateTime={at}>{formatMoment(at)}</time>
              </td>
              <td>{formatName(event)}</td>
              <td>
                <StateBadge state={state} />
              </td>
              <td className="number">{attempt || NOTHING}</td>
              <td className={classes.detail}>{detail}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
