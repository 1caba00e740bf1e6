/** Another name or note for a study. */
import { Button, Group, Modal, Stack, Textarea, TextInput } from '@mantine/core';
import { useEffect, useState } from 'react';
import type { StudyDetail } from '@/client/schema.gen';
import type { StudyWish } from '@/lib/use-study-action';

interface Props {
  study: StudyDetail;
  isOpen: boolean;
  onClose: () => void;
  onSend: (wish: StudyWish) => void;
}

export function EditDialog({ study, isOpen, onClose, onSend }: Props) {
  const [name, setName] = useState(study.name);
  const [note, setNote] = useState(study.note);
  useEffect(() => {
    if (isOpen) {
      setName(study.name);
      setNote(study.note);
    }
  }, [isOpen, study.name, study.note]);
  const save = (): void => {
    onSend({ action: 'change', studyId: study.id, change: { name: name.trim(), note } });
    onClose();
  };
  return (
    <Modal opened={isOpen} onClose={onClose} title="Edit the study" centered>
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
        <Group justify="flex-end" gap="xs">
          <Button variant="default" onClick={onClose}>
            Leave it
          </Button>
          <Button disabled={name.trim() === ''} onClick={save}>
            Save
          </Button>
        </Group>
      </Stack>
    </Modal>
  );
}
