/** The processes that train, and what they do. */
import { useQuery } from '@tanstack/react-query';
import { Freshness } from '@/components/freshness';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { formatAgo, secondsBetween } from '@/lib/format';
import { workersQuery } from '@/lib/queries';
import { useNow } from '@/lib/use-now';
import classes from './workers-page.module.css';

export function WorkersPage() {
  const { data, error, dataUpdatedAt } = useQuery(workersQuery);
  const now = useNow();
  return (
    <>
      <title>Workers · SLDR</title>
      <div className="page-head">
        <h1>Workers</h1>
        <Freshness updatedAt={dataUpdatedAt} />
      </div>
      {error && !data && (
        <SentencePanel urgent title="The workers cannot be shown">
          {sentence(error)}
        </SentencePanel>
      )}
      {data?.workers.length === 0 && (
        <SentencePanel title="No worker has ever been here">
          Start one with <code>sldr worker</code>; <code>sldr serve</code> starts one by itself.
        </SentencePanel>
      )}
      {data && data.workers.length > 0 && (
        <div className={`card ${classes.frame}`}>
          <table className={classes.table} aria-label="Workers">
            <thead>
              <tr>
                <th scope="col">Worker</th>
                <th scope="col">Host</th>
                <th scope="col">Process</th>
                <th scope="col">Busy slots</th>
                <th scope="col">Last sign of life</th>
              </tr>
            </thead>
            <tbody>
              {data.workers.map((worker) => (
                <tr key={worker.id}>
                  <th scope="row" className="mono">
                    {worker.id}
                  </th>
                  <td>{worker.host}</td>
                  <td className="number">{worker.pid}</td>
                  <td className="number">
                    {worker.busy} of {worker.slots}
                  </td>
                  <td data-state={worker.alive ? 'succeeded' : 'failed'} className={classes.life}>
                    {worker.alive ? 'alive' : 'gone'}, {formatAgo(secondsBetween(worker.last_heartbeat_at, now))}
                  </td>
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      )}
    </>
  );
}
