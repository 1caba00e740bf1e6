/** A few runs, one line each: name, state, progress, best success, and why it waits or ended so. */
import { AnchorLink } from '@/components/anchor-link';
import { ShareBar } from '@/components/share-bar';
import { StateBadge } from '@/components/state-badge';
import { formatShare } from '@/lib/format';
import type { StudyRun } from '@/lib/studies';
import classes from './study.module.css';

interface Props {
  runs: readonly StudyRun[];
  nameOf: (run: StudyRun) => string;
}

export function RunRows({ runs, nameOf }: Props) {
  return (
    <ul className={`card ${classes.runs}`}>
      {runs.map((run) => (
        <li key={run.run_id} className={classes.run}>
          <AnchorLink to="/runs/$runId" params={{ runId: run.run_id }} fw={600} fz="inherit">
            {nameOf(run)}
          </AnchorLink>
          <StateBadge state={run.state} />
          <span className={classes.runProgress}>
            <ShareBar share={run.progress} state={run.state} label={`Progress of ${nameOf(run)}`} />
          </span>
          <span className="number" title="Success of its best test">
            best {formatShare(run.best_success_rate)}
          </span>
          {run.reason && <span className={`faint ${classes.reason}`}>{run.reason}</span>}
        </li>
      ))}
    </ul>
  );
}
