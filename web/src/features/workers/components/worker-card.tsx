/** One worker: where it is, what it has, what it trains, and whether it is still there. */
import { Button } from '@mantine/core';
import type { ReactNode } from 'react';
import type { RunState, Worker } from '@/client/schema.gen';
import { AnchorLink } from '@/components/anchor-link';
import { OnlyFor } from '@/components/only-for';
import { useComplaint, useToast } from '@/components/toasts';
import { formatAgo, formatShare, formatSize, NOTHING, secondsBetween } from '@/lib/format';
import { runTitle } from '@/lib/run-title';
import { useNow } from '@/lib/use-now';
import { useSetDraining } from '../api/set-draining';
import classes from './worker-card.module.css';

export function WorkerCard({ worker }: { worker: Worker }) {
  const { host, pid, id, executor, slots, running, cores, processor, gpu } = worker;
  return (
    <li className={`card ${classes.card}`} data-worker={id}>
      <div className={classes.head}>
        <h2>{host}</h2>
        {worker.draining && <span className={classes.draining}>draining</span>}
        <Life worker={worker} />
      </div>
      <div className="faint">
        {executor} · process {pid} · <span className="mono">{id}</span>
      </div>
      <dl className={classes.facts}>
        <Fact name="Slots busy">
          {running.length} of {slots}
        </Fact>
        <Fact name="Cores">
          {cores || NOTHING}
          {processor !== null && ` of ${processor}`}
        </Fact>
        <Fact name="GPU">{gpu ?? 'none'}</Fact>
        <Fact name="Memory">
          <Memory worker={worker} />
        </Fact>
      </dl>
      <Runs worker={worker} />
      {worker.alive && (
        <OnlyFor least="operator">
          <Drain worker={worker} />
        </OnlyFor>
      )}
    </li>
  );
}

function Fact({ name, children }: { name: string; children: ReactNode }) {
  return (
    <div>
      <dt className="faint">{name}</dt>
      <dd className="number">{children}</dd>
    </div>
  );
}

/** A sign of life older than this is late: they come every 10 s [s]. */
const LATE_AFTER_S = 20;

function Life({ worker }: { worker: Worker }) {
  const now = useNow();
  const silent = secondsBetween(worker.last_heartbeat_at, now) ?? 0;
  const [word, state]: [string, RunState] = !worker.alive
    ? ['gone', 'failed']
    : silent > LATE_AFTER_S
      ? ['late', 'blocked']
      : ['alive', 'succeeded'];
  return (
    <span className={classes.life} data-state={state} title="Its last sign of life">
      <span className={classes.dot} aria-hidden="true" />
      {word}, {formatAgo(silent)}
    </span>
  );
}

function Memory({ worker: { memory_total: total, memory_used: used } }: { worker: Worker }) {
  if (total === 0) return <>{NOTHING}</>;
  const share = Math.min(1, used / total);
  return (
    <span className={classes.memory}>
      <span className={classes.track} aria-hidden="true" title={formatShare(share)}>
        <span style={{ width: `${share * 100}%` }} />
      </span>
      {formatSize(used)} of {formatSize(total)}
    </span>
  );
}

function Runs({ worker: { running, alive, draining } }: { worker: Worker }) {
  if (running.length === 0) {
    const idle = draining ? 'It trains nothing and takes nothing: it can be ended.' : 'It trains nothing just now.';
    return <p className={`faint ${classes.idle}`}>{alive ? idle : 'What it trained goes back to the queue.'}</p>;
  }
  return (
    <ul className={classes.runs} aria-label="Runs that it trains">
      {running.map((run) => (
        <li key={run.id}>
          <AnchorLink to="/runs/$runId" params={{ runId: run.id }} fz="inherit">
            {runTitle(run)}
          </AnchorLink>
        </li>
      ))}
    </ul>
  );
}

function Drain({ worker: { id, draining, host } }: { worker: Worker }) {
  const toast = useToast();
  const complain = useComplaint();
  const setting = useSetDraining(id);
  const set = (): void => {
    const text = draining ? `${host} takes runs again.` : `${host} takes no further run and keeps those that it has.`;
    // It is told wherever one is by then.
    setting.mutateAsync(!draining).then(() => toast({ text }), complain);
  };
  return (
    <Button
      variant={draining ? 'light' : 'default'}
      size="compact-sm"
      loading={setting.isPending}
      onClick={set}
      title={draining ? undefined : 'It takes no further run and keeps those that it has.'}
    >
      {draining ? 'Take runs again' : 'Drain'}
    </Button>
  );
}
