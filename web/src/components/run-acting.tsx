/** Do something to runs: ask first where something is lost, say what became of it, offer the way back. */
import { Button, Group, Modal, Text } from '@mantine/core';
import { type ReactNode, useState } from 'react';
import { useToast } from '@/components/toasts';
import { sentence } from '@/lib/api';
import { formatPlural } from '@/lib/format';
import { type Actable, type Action, summarise } from '@/lib/run-actions';
import { useRunActions } from '@/lib/use-run-actions';

export interface RunActing {
  /** Do it, or ask first. */
  readonly act: (action: Action, runs: readonly Actable[]) => void;
  readonly isActing: boolean;
  /** The question, to be put anywhere on the page. */
  readonly question: ReactNode;
}

/** @param onDone called with the ids for which it was done */
export function useRunActing(onDone?: (action: Action, runIds: readonly string[]) => void): RunActing {
  const toast = useToast();
  const wishes = useRunActions();
  const [asked, setAsked] = useState<readonly Actable[]>([]);

  const send = (action: Action, runIds: readonly string[]): void => {
    wishes.mutate(
      { action, runIds },
      {
        onSuccess: ({ results }) => {
          const { doneIds, ...notice } = summarise(action, results);
          const undo = action === 'delete' && doneIds.length > 0 ? () => send('restore', doneIds) : undefined;
          toast({ ...notice, undo });
          if (doneIds.length > 0) onDone?.(action, doneIds);
        },
        onError: (error) => toast({ text: sentence(error), isProblem: true }),
      },
    );
  };
  const act = (action: Action, runs: readonly Actable[]): void => {
    if (action === 'cancel' && runs.some((run) => run.state === 'running')) setAsked(runs);
    else
      send(
        action,
        runs.map((run) => run.id),
      );
  };
  const close = (): void => setAsked([]);
  const confirm = (): void => {
    send(
      'cancel',
      asked.map((run) => run.id),
    );
    close();
  };
  const question = (
    <Modal opened={asked.length > 0} onClose={close} title={questionOf(asked)} centered>
      <Text size="sm">
        Training ends within seconds, and what was learnt since the last checkpoint is lost. Curves and files stay, and
        a cancelled run can be retried from its checkpoint. To go on later without any loss, pause instead.
        {asked.some((run) => run.phase === 'locomotion') && ' Manipulation runs that need it go on waiting.'}
      </Text>
      <Group justify="flex-end" mt="lg" gap="xs">
        <Button variant="default" onClick={close} data-autofocus>
          Keep {asked.length > 1 ? 'them' : 'it'}
        </Button>
        <Button color="red.9" onClick={confirm}>
          Yes, cancel {asked.length > 1 ? 'them' : 'it'}
        </Button>
      </Group>
    </Modal>
  );
  return { act, isActing: wishes.isPending, question };
}

function questionOf(runs: readonly Actable[]): string {
  return runs.length > 1 ? `Cancel ${formatPlural(runs.length, 'run')}?` : 'Cancel this run?';
}
