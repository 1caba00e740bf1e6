/** The button for what a person would do first about a run that waits for one. */
import { Button } from '@mantine/core';
import { useRunActing } from '@/components/run-acting';
import { useMay } from '@/lib/access';
import { ACTION_MEANING, ACTION_NAMES, type Actable, type Action, allows } from '@/lib/run-actions';

const REMEDIES: readonly Action[] = ['resume', 'release', 'retry'];

export function RunRemedy({ run }: { run: Actable }) {
  const { act, isActing } = useRunActing();
  const isMine = useMay('operator');
  // Who cancelled a run knows why; one that failed wants a look.
  const action = run.state === 'cancelled' ? undefined : REMEDIES.find((remedy) => allows(run, remedy));
  if (action === undefined || !isMine) return null;
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
