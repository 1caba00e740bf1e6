/** What stands in place of the curves while a run waits for its locomotion models. */
import { Button } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import type { RunDetail } from '@/client/schema.gen';
import { AnchorLink, ButtonLink } from '@/components/anchor-link';
import { OnlyFor } from '@/components/only-for';
import { useRunActing } from '@/components/run-acting';
import { RunProgress } from '@/components/run-progress';
import { SentencePanel } from '@/components/sentence-panel';
import { StateBadge } from '@/components/state-badge';
import { formatShare } from '@/lib/format';
import { runQuery } from '@/lib/queries';
import { ACTION_MEANING, ACTION_NAMES } from '@/lib/run-actions';
import { valueAt } from '@/lib/settings';
import { wishOf } from '@/lib/states';
import classes from './run.module.css';

export function WaitingPanel({ run }: { run: RunDetail }) {
  // Of several needed runs, the reason names the one that holds this run back.
  const shownId = run.needs.find((id) => run.reason?.includes(id)) ?? run.needs[0];
  return (
    <SentencePanel
      title={run.is_below_gate ? 'The object has not learnt well enough' : 'The object learns first'}
      actions={
        <>
          {shownId !== undefined && (
            <ButtonLink to="/runs/$runId" params={{ runId: shownId }} variant="default">
              {run.is_below_gate ? 'See the locomotion run' : 'Watch the locomotion run'}
            </ButtonLink>
          )}
          {run.is_below_gate && (
            <OnlyFor least="operator">
              <Release run={run} />
            </OnlyFor>
          )}
        </>
      }
    >
      {run.is_below_gate
        ? `The robot is rewarded for moving the object as the object would move itself, so a poor model teaches it the wrong thing. That is why the run waits: its gate asks for a test success of ${formatShare(Number(valueAt(run.config, 'sldr.gate')), 1)}.`
        : (run.reason ?? 'The run starts by itself once its locomotion model is good enough.')}
      {run.needs.map((id) => (
        <Needed key={id} runId={id} isOneOfMany={run.needs.length > 1} />
      ))}
    </SentencePanel>
  );
}

function Needed({ runId, isOneOfMany }: { runId: string; isOneOfMany: boolean }) {
  const { data: locomotion } = useQuery(runQuery(runId));
  if (locomotion === undefined) return null;
  return (
    <span className={classes.waiting}>
      <StateBadge state={locomotion.state} wish={wishOf(locomotion)} />
      <RunProgress progress={locomotion.progress} state={locomotion.state} label="Progress of the locomotion run" />
      <span className="number">test success {formatShare(locomotion.progress?.success_rate, 1)}</span>
      {isOneOfMany && (
        <AnchorLink to="/runs/$runId" params={{ runId }} fz="inherit">
          {locomotion.task}
        </AnchorLink>
      )}
    </span>
  );
}

function Release({ run }: { run: RunDetail }) {
  const { act, isActing } = useRunActing();
  return (
    <Button loading={isActing} title={ACTION_MEANING.release} onClick={() => act('release', [run])}>
      {ACTION_NAMES.release}
    </Button>
  );
}
