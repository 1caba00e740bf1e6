/** How much of something is done, as a bar in a state's colour. */
import type { RunState } from '@/client/schema.gen';
import { formatShare } from '@/lib/format';
import classes from './run-progress.module.css';

interface Props {
  share: number;
  state: RunState;
  /** What the bar is about, for a screen reader. */
  label: string;
}

export function ShareBar({ share, state, label }: Props) {
  return (
    <span
      className={classes.track}
      role="progressbar"
      aria-label={label}
      aria-valuenow={Math.round(share * 100)}
      aria-valuemin={0}
      aria-valuemax={100}
      aria-valuetext={formatShare(share)}
    >
      <span className={classes.fill} data-state={state} style={{ width: `${share * 100}%` }} />
    </span>
  );
}
