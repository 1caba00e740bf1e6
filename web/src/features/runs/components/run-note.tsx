/** Why a run waits or ended so, with the way to the run it waits for. */
import type { RunSummary } from '@/client/schema.gen';
import { AnchorLink } from '@/components/anchor-link';
import { formatShare } from '@/lib/format';
import classes from './runs.module.css';

/** Whether there is anything to say below a run. */
export function hasNote(run: RunSummary): boolean {
  return run.reason !== null || (run.state === 'blocked' && run.needs.length > 0);
}

export function RunNote({ run, runs }: { run: RunSummary; runs: readonly RunSummary[] }) {
  const links = run.state === 'blocked' ? run.needs : [];
  return (
    <span className={classes.noteText} data-state={run.state}>
      {run.reason && <span>{run.reason}</span>}
      {links.map((id) => (
        <span key={id} className={classes.waits}>
          {run.reason ? '→ ' : 'Waits for '}
          <AnchorLink to="/runs/$runId" params={{ runId: id }} fz="inherit">
            {needName(runs.find((other) => other.id === id))}
          </AnchorLink>
        </span>
      ))}
    </span>
  );
}

function needName(run: RunSummary | undefined): string {
  if (run === undefined) return 'its locomotion run';
  const share = run.state === 'running' && run.progress ? `, ${formatShare(run.progress.fraction)}` : '';
  return `the locomotion run of seed ${run.seed} (${run.state}${share})`;
}
