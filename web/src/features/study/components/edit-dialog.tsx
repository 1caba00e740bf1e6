/** Another name or note for a study. */
import { Button, Group, Modal, Stack, Textarea, TextInput } from '@mantine/core';
import { useState } from 'react';
import type { StudyDetail } from '@/client/schema.gen';
import { sentence } from '@/lib/api';
import { useDialogWish } from '../use-dialog-wish';

interface Props {
  study: StudyDetail;
  isOpen: boolean;
  onClose: () => void;
}

export function EditDialog({ study, isOpen, onClose }: Props) {
  return (
    <Modal opened={isOpen} onClose={onClose} title="Edit the study" centered>
      {isOpen && <Form study={study} onClose={onClose} />}
    </Modal>
  );
}

function Form({ study, onClose }: Omit<Props, 'isOpen'>) {
  const [name, setName] = useState(study.name);
  const [note, setNote] = useState(study.note);
  const { send, error, isPending } = useDialogWish(onClose);
  return (
    <Stack gap="sm">
      <TextInput
        label="Name"
        maxLength={80}
        value={name}
        data-autofocus
        error={name.trim() === '' ? 'Give it a name.' : undefined}
        onChange={(event) => setName(event.currentTarget.value)}
      />
      <Textarea
        label="Note"
        description="What it is for, or what it showed."
        rows={4}
        maxLength={10_000}
        value={note}
        onChange={(event) => setNote(event.currentTarget.value)}
      />
      {error && (
        <p className="problem" role="alert">
          {sentence(error)}
        </p>
      )}
      <Group justify="flex-end" gap="xs">
        <Button variant="default" onClick={onClose}>
          Leave it
        </Button>
        <Button
          disabled={name.trim() === ''}
          loading={isPending}
          onClick={() => send({ action: 'change', studyId: study.id, change: { name: name.trim(), note } })}
        >
          Save
        </Button>
      </Group>
    </Stack>
  );
}
