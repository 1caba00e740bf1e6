/** What stands in place of the curves while a run waits for its locomotion model. */
import { useQuery } from '@tanstack/react-query';
import type { RunDetail } from '@/client/schema.gen';
import { ButtonLink } from '@/components/anchor-link';
import { RunProgress } from '@/components/run-progress';
import { SentencePanel } from '@/components/sentence-panel';
import { StateBadge } from '@/components/state-badge';
import { formatShare } from '@/lib/format';
import { runQuery } from '@/lib/queries';
import classes from './run.module.css';

export function WaitingPanel({ run, locomotionId }: { run: RunDetail; locomotionId: string }) {
  const { data: locomotion } = useQuery(runQuery(locomotionId));
  return (
    <SentencePanel
      title="The object learns first"
      actions={
        <ButtonLink to="/runs/$runId" params={{ runId: locomotionId }} variant="default">
          Watch the locomotion run
        </ButtonLink>
      }
    >
      {run.reason ?? 'The run starts by itself once its locomotion model is good enough.'}
      {locomotion && (
        <span className={classes.waiting}>
          <StateBadge state={locomotion.state} />
          <RunProgress progress={locomotion.progress} state={locomotion.state} label="Progress of the locomotion run" />
          <span className="number">test success {formatShare(locomotion.progress?.success_rate)}</span>
        </span>
      )}
    </SentencePanel>
  );
}
