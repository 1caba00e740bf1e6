/** Cancel a run, after asking once. */
import { Button, Group, Modal, Text } from '@mantine/core';
import { useDisclosure } from '@mantine/hooks';
import type { RunDetail } from '@/client/schema.gen';
import { sentence } from '@/lib/api';
import { runTitle } from '@/lib/run-title';
import { useCancelRun } from '../api/cancel-run';

export function CancelButton({ run }: { run: RunDetail }) {
  const [isAsking, { open, close }] = useDisclosure(false);
  const cancelling = useCancelRun(run.id);
  if (run.cancel_requested) return null;
  return (
    <>
      <Button variant="default" size="xs" onClick={open}>
        Cancel run
      </Button>
      <Modal opened={isAsking} onClose={close} title="Cancel this run?" centered>
        <Text size="sm">
          {runTitle(run)} ends for good. What it has learnt so far, its curves and its files stay.
          {run.phase === 'locomotion' && ' Manipulation runs that wait for it will go on waiting.'}
        </Text>
        {cancelling.error && (
          <p className="problem" role="alert">
            {sentence(cancelling.error)}
          </p>
        )}
        <Group justify="flex-end" mt="lg" gap="xs">
          <Button variant="default" onClick={close} data-autofocus>
            Keep it
          </Button>
          <Button
            color="red"
            loading={cancelling.isPending}
            onClick={() => cancelling.mutate(undefined, { onSuccess: close })}
          >
            Yes, cancel it
          </Button>
        </Group>
      </Modal>
    </>
  );
}
