/** The run's figures in one strip. */
import type { ReactNode } from 'react';
import type { RunDetail } from '@/client/schema.gen';
import { RunProgress } from '@/components/run-progress';
import {
  formatCount,
  formatDuration,
  formatMoment,
  formatRate,
  formatShare,
  NOTHING,
  secondsBetween,
} from '@/lib/format';
import { useNow } from '@/lib/use-now';
import classes from './run.module.css';

export function RunFigures({ run }: { run: RunDetail }) {
  const { progress } = run;
  const isRunning = run.state === 'running';
  return (
    <dl className={`card ${classes.figures}`} aria-label="Figures">
      <Figure name="Progress" isWide>
        <RunProgress progress={progress} state={run.state} label="Progress" />
      </Figure>
      <Figure name="Test success">
        <b>{formatShare(progress?.success_rate, 1)}</b>
      </Figure>
      <Figure name="Best">{formatShare(progress?.best_success_rate, 1)}</Figure>
      <Figure name="Env steps">{formatCount(progress?.env_steps)}</Figure>
      <Figure name="Env steps/s">{isRunning ? formatRate(progress?.env_steps_per_s) : NOTHING}</Figure>
      <Figure name="Updates/s">{isRunning ? formatRate(progress?.updates_per_s) : NOTHING}</Figure>
      <Figure name="Time left">{isRunning ? formatDuration(progress?.seconds_left) : NOTHING}</Figure>
      <Figure name="Duration">
        <span title={run.started_at ? `Started ${formatMoment(run.started_at)}` : undefined}>
          <Duration run={run} />
        </span>
      </Figure>
    </dl>
  );
}

function Figure({ name, isWide, children }: { name: string; isWide?: boolean; children: ReactNode }) {
  return (
    <div data-wide={isWide || undefined}>
      <dt>{name}</dt>
      <dd className="number">{children}</dd>
    </div>
  );
}

function Duration({ run }: { run: RunDetail }) {
  const now = useNow();
  if (run.started_at === null) return NOTHING;
  return <>{formatDuration(run.trained_s + (secondsBetween(run.training_since, now) ?? 0))}</>;
}
