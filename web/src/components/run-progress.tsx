/** How far a run is: a bar, and the epoch it is in. */
import type { Progress, RunState } from '@/client/schema.gen';
import { formatShare, NOTHING } from '@/lib/format';
import classes from './run-progress.module.css';

interface Props {
  progress: Progress | null;
  state: RunState;
  /** What the bar is about, for a screen reader. */
  label: string;
}

export function RunProgress({ progress, state, label }: Props) {
  if (progress === null) return <span className="faint">{NOTHING}</span>;
  const share = state === 'succeeded' ? 1 : Math.min(1, Math.max(0, progress.fraction));
  const early = state === 'succeeded' && progress.fraction < 1;
  return (
    <span className={classes.row}>
      <span
        className={classes.track}
        role="progressbar"
        aria-label={label}
        aria-valuenow={Math.round(share * 100)}
        aria-valuemin={0}
        aria-valuemax={100}
        aria-valuetext={`epoch ${progress.epoch} of ${progress.epochs}, ${formatShare(share)}`}
      >
        <span className={classes.fill} data-state={state} style={{ width: `${share * 100}%` }} />
      </span>
      <span className={classes.epochs} title={early ? 'Ended early: the goal was reached.' : undefined}>
        {progress.epoch}/{progress.epochs}
      </span>
    </span>
  );
}
