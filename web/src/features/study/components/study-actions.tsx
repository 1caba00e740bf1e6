/** What can be done with a study: compare, fill, retry, add to it, copy, delete and bring back. */
import { Button } from '@mantine/core';
import { useDisclosure } from '@mantine/hooks';
import type { StudyDetail } from '@/client/schema.gen';
import { ButtonLink } from '@/components/anchor-link';
import { Icon } from '@/components/icon';
import { useComplaint, useToast } from '@/components/toasts';
import { useMay } from '@/lib/access';
import { type StudyWish, useStudyAction } from '@/lib/use-study-action';
import { AddDialog } from './add-dialog';
import { EditDialog } from './edit-dialog';
import classes from './study.module.css';

export function StudyActions({ study }: { study: StudyDetail }) {
  const toast = useToast();
  const complain = useComplaint();
  const wishes = useStudyAction();
  const isMine = useMay('operator');
  const [isAdding, adding] = useDisclosure(false);
  const [isEditing, editing] = useDisclosure(false);
  // What became of it is told wherever one is by then.
  const send = (wish: StudyWish, undo?: () => void): void =>
    void wishes.mutateAsync(wish).then((text) => toast({ text, undo }), complain);
  const act = (action: 'fill' | 'retry-failed' | 'retry-cancelled' | 'restore'): void =>
    send({ action, studyId: study.id });
  const missing = study.cells.reduce((sum, cell) => sum + cell.missing_seeds.length, 0);
  const count = (state: 'failed' | 'cancelled'): number =>
    (study.states[state] ?? 0) + study.locomotion.filter((run) => run.state === state).length;
  if (!isMine) return <Ways study={study} />;
  if (study.deleted_at !== null) {
    return (
      <span className={classes.actions}>
        <Button size="xs" loading={wishes.isPending} onClick={() => act('restore')}>
          Restore
        </Button>
      </span>
    );
  }
  return (
    <span className={classes.actions}>
      <Ways study={study} />
      {missing > 0 && (
        <Button size="xs" variant="light" loading={wishes.isPending} onClick={() => act('fill')}>
          Fill {missing} missing
        </Button>
      )}
      {count('failed') > 0 && (
        <Button size="xs" variant="light" loading={wishes.isPending} onClick={() => act('retry-failed')}>
          Retry {count('failed')} failed
        </Button>
      )}
      {count('cancelled') > 0 && (
        <Button size="xs" variant="default" loading={wishes.isPending} onClick={() => act('retry-cancelled')}>
          Retry {count('cancelled')} cancelled
        </Button>
      )}
      <Button size="xs" variant="default" onClick={adding.open}>
        Add seeds …
      </Button>
      <Button size="xs" variant="default" leftSection={<Icon name="edit" size={13} />} onClick={editing.open}>
        Edit
      </Button>
      <ButtonLink to="/studies/new" search={{ from: study.id }} size="xs" variant="default">
        Clone
      </ButtonLink>
      <Button
        size="xs"
        variant="default"
        leftSection={<Icon name="trash" size={13} />}
        onClick={() => send({ action: 'delete', studyId: study.id }, () => act('restore'))}
      >
        Delete
      </Button>
      <AddDialog study={study} isOpen={isAdding} onClose={adding.close} />
      <EditDialog study={study} isOpen={isEditing} onClose={editing.close} />
    </span>
  );
}

/** What everybody may do: look at its curves, and take it along. */
function Ways({ study }: { study: StudyDetail }) {
  return (
    <>
      <ButtonLink to="/compare" search={{ study: study.id }} size="xs" leftSection={<Icon name="chart" size={14} />}>
        Compare
      </ButtonLink>
      <Export study={study} />
    </>
  );
}

function Export({ study }: { study: StudyDetail }) {
  if (!study.states.succeeded) {
    return (
      <Button disabled size="xs" variant="default" title="It can be exported once a run has succeeded">
        Export
      </Button>
    );
  }
  return (
    <Button
      component="a"
      href={`/api/study-files/${study.id}`}
      download
      size="xs"
      variant="default"
      title="One file with the runs that have succeeded, for another installation"
    >
      Export
    </Button>
  );
}
