/** What happened to the run: its attempts, and every change, oldest first. */
import { useQuery } from '@tanstack/react-query';
import type { RunEvent } from '@/client/schema.gen';
import { SentencePanel } from '@/components/sentence-panel';
import { StateBadge } from '@/components/state-badge';
import { sentence } from '@/lib/api';
import { formatMoment, formatName, NOTHING } from '@/lib/format';
import { eventsQuery } from '../api/run-records';
import { Attempts } from './attempts-table';
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
    <>
      <Attempts runId={runId} />
      <section className={classes.part}>
        <h2>Events</h2>
        <Events events={data?.events ?? []} />
      </section>
    </>
  );
}

function Events({ events }: { events: readonly RunEvent[] }) {
  return (
    <div className={`card ${classes.tableFrame}`}>
      <table className={classes.table} aria-label="Events">
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
          {events.map(({ at, event, state, attempt, detail }) => (
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
