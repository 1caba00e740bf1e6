/** Ask before runs that train are ended: something is lost then. */
import { Button, Group, Modal, Text } from '@mantine/core';
import { formatPlural } from '@/lib/format';
import type { Actable } from '@/lib/run-actions';

interface Props {
  /** What would be cancelled; none: nothing is asked now. */
  runs: readonly Actable[];
  onKeep: () => void;
  onConfirm: () => void;
}

export function CancelQuestion({ runs, onKeep, onConfirm }: Props) {
  const them = runs.length > 1 ? 'them' : 'it';
  return (
    // Whoever asks gives the focus back: what was pressed may be gone, or had lost it before this was loaded.
    <Modal opened={runs.length > 0} onClose={onKeep} title={questionOf(runs)} centered returnFocus={false}>
      <Text size="sm">
        Training ends within seconds, and what was learnt since the last checkpoint is lost. Curves and files stay, and
        a cancelled run can be retried from its checkpoint. To go on later without any loss, pause instead.
        {runs.some((run) => run.phase === 'locomotion') && ' Manipulation runs that need it go on waiting.'}
      </Text>
      <Group justify="flex-end" mt="lg" gap="xs">
        <Button variant="default" onClick={onKeep} data-autofocus>
          Keep {them}
        </Button>
        <Button color="red.9" onClick={onConfirm}>
          Yes, cancel {them}
        </Button>
      </Group>
    </Modal>
  );
}

function questionOf(runs: readonly Actable[]): string {
  return runs.length > 1 ? `Cancel ${formatPlural(runs.length, 'run')}?` : 'Cancel this run?';
}
