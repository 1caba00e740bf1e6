/** Why a run waits or ended so, with the way to the run it waits for, and what can be done about it. */
import type { RunSummary } from '@/client/schema.gen';
import { Reason } from '@/components/reason';
import { RunRemedy } from '@/components/run-remedy';
import { formatShare } from '@/lib/format';
import type { Lines } from '../lines';
import classes from './lines.module.css';

/** Whether there is anything to say below a run. */
export function hasNote(run: RunSummary): boolean {
  return run.reason !== null || (run.state === 'blocked' && run.needs.length > 0);
}

export function RunNote({ run, findRun }: { run: RunSummary; findRun: Lines['findRun'] }) {
  const waits = run.needs.map((id) => `Waits for the locomotion run ${id}.`).join(' ');
  return (
    <span className={classes.noteText} data-state={run.state}>
      <Reason text={run.reason ?? waits} runIds={run.needs} describe={(id) => standing(findRun(id))} />
      <RunRemedy run={run} />
    </span>
  );
}

function standing(run: RunSummary | undefined): string {
  if (run === undefined) return '';
  const share = run.state === 'running' && run.progress ? `, ${formatShare(run.progress.fraction)}` : '';
  return ` (${run.state}${share})`;
}
