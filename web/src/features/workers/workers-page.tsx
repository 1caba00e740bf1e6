/** The processes that train, and what they do. */
import { useQuery } from '@tanstack/react-query';
import type { Worker } from '@/client/schema.gen';
import { Freshness } from '@/components/freshness';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { workersQuery } from '@/lib/queries';
import { WorkerCard } from './components/worker-card';
import classes from './workers-page.module.css';

export function WorkersPage() {
  const { data, error, dataUpdatedAt } = useQuery(workersQuery);
  return (
    <>
      <title>Workers · SLDR</title>
      <div className="page-head">
        <h1>Workers</h1>
        {data && data.workers.length > 0 && <span className="faint number">{summary(data.workers)}</span>}
        <Freshness updatedAt={dataUpdatedAt} />
      </div>
      {error && !data && (
        <SentencePanel urgent title="The workers cannot be shown">
          {sentence(error)}
        </SentencePanel>
      )}
      {data?.workers.length === 0 && (
        <SentencePanel title="No worker has been here lately">
          Queued runs wait for one. Start it with <code>sldr worker</code>; <code>sldr serve</code> starts one by
          itself.
        </SentencePanel>
      )}
      {data && data.workers.length > 0 && (
        <ul className={classes.workers} aria-label="Workers">
          {data.workers.map((worker) => (
            <WorkerCard key={worker.id} worker={worker} />
          ))}
        </ul>
      )}
    </>
  );
}

function summary(workers: readonly Worker[]): string {
  const alive = workers.filter((worker) => worker.alive);
  const slots = alive.reduce((sum, worker) => sum + worker.slots, 0);
  const busy = alive.reduce((sum, worker) => sum + worker.running.length, 0);
  return `${alive.length} alive · ${busy} of ${slots} slots busy`;
}
