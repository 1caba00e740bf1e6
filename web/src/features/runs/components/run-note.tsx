/** Why a run waits or ended so, with the way to the run it waits for, and what can be done about it. */
import { Button } from '@mantine/core';
import type { RunSummary } from '@/client/schema.gen';
import { Reason } from '@/components/reason';
import { useRunActing } from '@/components/run-acting';
import { formatShare } from '@/lib/format';
import { ACTION_MEANING, ACTION_NAMES, type Action, allows } from '@/lib/run-actions';
import classes from './runs.module.css';

/** Whether there is anything to say below a run. */
export function hasNote(run: RunSummary): boolean {
  return run.reason !== null || (run.state === 'blocked' && run.needs.length > 0);
}

export function RunNote({ run, runs }: { run: RunSummary; runs: readonly RunSummary[] }) {
  const waits = run.needs.map((id) => `Waits for the locomotion run ${id}.`).join(' ');
  return (
    <span className={classes.noteText} data-state={run.state}>
      <Reason
        text={run.reason ?? waits}
        runIds={run.needs}
        describe={(id) => standing(runs.find((other) => other.id === id))}
      />
      <Remedy run={run} />
    </span>
  );
}

/** What a person would do first about a run that needs one. */
const REMEDIES: readonly Action[] = ['retry', 'release'];

function Remedy({ run }: { run: RunSummary }) {
  const { act, isActing } = useRunActing();
  // Who cancelled a run knows why; one that failed wants a look.
  const action = REMEDIES.find((remedy) => allows(run, remedy) && run.state !== 'cancelled');
  if (action === undefined) return null;
  return (
    <Button
      variant="light"
      size="compact-xs"
      loading={isActing}
      title={ACTION_MEANING[action]}
      onClick={() => act(action, [run])}
    >
      {ACTION_NAMES[action]}
    </Button>
  );
}

function standing(run: RunSummary | undefined): string {
  if (run === undefined) return '';
  const share = run.state === 'running' && run.progress ? `, ${formatShare(run.progress.fraction)}` : '';
  return ` (${run.state}${share})`;
}
