/** The figures of a run that the table and the cards both show. */
import type { Progress, RunSummary } from '@/client/schema.gen';
import { formatAgo, formatMoment, formatShare, formatShort, NOTHING, secondsBetween } from '@/lib/format';
import { useNow } from '@/lib/use-now';
import classes from './lines.module.css';

/** Success of the newest test, and the best so far. */
export function Success({ progress }: { progress: Progress | null }) {
  if (progress?.success_rate == null) return <>{NOTHING}</>;
  return (
    <>
      <b className={classes.newest}>{formatShare(progress.success_rate)}</b>
      <span className="faint" title="Best of all tests">
        {' / '}
        {formatShare(progress.best_success_rate)}
      </span>
    </>
  );
}

/** Env steps per second, and updates per second, while it trains. */
export function Speed({ run }: { run: RunSummary }) {
  if (run.state !== 'running' || run.progress?.env_steps_per_s == null) return NOTHING;
  const { env_steps_per_s, updates_per_s } = run.progress;
  return (
    <span title={`${formatShort(env_steps_per_s)} env steps/s, ${formatShort(updates_per_s)} updates/s`}>
      {formatShort(env_steps_per_s)}
      <span className="faint"> / {formatShort(updates_per_s)}</span>
    </span>
  );
}

/** How long ago it was launched; the moments of launch and start on hover. */
export function Launched({ run }: { run: RunSummary }) {
  const now = useNow(10_000);
  const start = run.started_at === null ? 'not started yet' : `started ${formatMoment(run.started_at)}`;
  return (
    <time dateTime={run.created_at} title={`${formatMoment(run.created_at)}, ${start}`} className="faint">
      {formatAgo(secondsBetween(run.created_at, now))}
    </time>
  );
}
