/** The run's figures in one strip. */
import type { ReactNode } from 'react';
import type { RunDetail } from '@/client/schema.gen';
import { Elapsed } from '@/components/elapsed';
import { RunProgress } from '@/components/run-progress';
import { formatCount, formatEstimate, formatMoment, formatRate, formatShare, NOTHING } from '@/lib/format';
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
      <Figure name="Time left">{isRunning ? formatEstimate(progress?.seconds_left) : NOTHING}</Figure>
      <Figure name="Duration">
        <span title={run.started_at ? `Started ${formatMoment(run.started_at)}` : undefined}>
          <Elapsed run={run} />
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
