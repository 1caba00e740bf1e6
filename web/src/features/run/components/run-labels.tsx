/** What people wrote on a run: its tags and its notes, and the fields to change them. */
import { Button, Group, Textarea } from '@mantine/core';
import { type ReactNode, useState } from 'react';
import type { RunDetail } from '@/client/schema.gen';
import { OnlyFor } from '@/components/only-for';
import { TagChips } from '@/components/tag-chips';
import { TagField } from '@/components/tag-field';
import { useComplaint } from '@/components/toasts';
import { LONGEST_NOTES, useChangeTags, useSetNotes } from '@/lib/labels';
import classes from './run-labels.module.css';

type Part = 'tags' | 'notes';

/** Fields and buttons take each other's place, so that whichever comes takes the focus of the one that goes. */
const takeFocus = (element: HTMLElement | null): void => element?.focus();

export function RunLabels({ run }: { run: RunDetail }) {
  const [edited, setEdited] = useState<Part | null>(null);
  const [left, setLeft] = useState<Part | null>(null);
  const close = (): void => {
    setLeft(edited);
    setEdited(null);
  };
  if (edited === 'tags') return <TagsForm run={run} onDone={close} />;
  if (edited === 'notes') return <NotesForm run={run} onDone={close} />;
  return (
    <div className={classes.labels}>
      <TagChips tags={run.tags} />
      <OnlyFor least="operator">
        <Button
          ref={left === 'tags' ? takeFocus : undefined}
          variant="subtle"
          size="compact-xs"
          onClick={() => setEdited('tags')}
        >
          {run.tags.length > 0 ? 'Edit tags' : 'Add tags'}
        </Button>
        <Button
          ref={left === 'notes' ? takeFocus : undefined}
          variant="subtle"
          size="compact-xs"
          onClick={() => setEdited('notes')}
        >
          {run.notes === '' ? 'Add notes' : 'Edit notes'}
        </Button>
      </OnlyFor>
      {run.notes !== '' && <p className={classes.notes}>{run.notes}</p>}
    </div>
  );
}

interface FormProps {
  run: RunDetail;
  onDone: () => void;
}

function TagsForm({ run, onDone }: FormProps) {
  // Tags that others give or take meanwhile are theirs: only what was changed here is sent.
  const [first] = useState<readonly string[]>(run.tags);
  const [tags, setTags] = useState<readonly string[]>(first);
  const changing = useChangeTags();
  const wish = {
    runIds: [run.id],
    add: tags.filter((tag) => !first.includes(tag)),
    remove: first.filter((tag) => !tags.includes(tag)),
  };
  return (
    <Form isBusy={changing.isPending} save={() => changing.mutateAsync(wish)} onDone={onDone}>
      <TagField ref={takeFocus} label="Tags" value={tags} onChange={setTags} placeholder="Type, then Enter" />
    </Form>
  );
}

function NotesForm({ run, onDone }: FormProps) {
  const [notes, setNotes] = useState(run.notes);
  const setting = useSetNotes(run.id);
  return (
    <Form isBusy={setting.isPending} save={() => setting.mutateAsync(notes)} onDone={onDone}>
      <Textarea
        ref={takeFocus}
        size="xs"
        label="Notes, as plain text"
        autosize
        minRows={3}
        maxRows={14}
        maxLength={LONGEST_NOTES}
        value={notes}
        onChange={(event) => setNotes(event.currentTarget.value)}
      />
    </Form>
  );
}

interface FrameProps {
  isBusy: boolean;
  save: () => Promise<void>;
  onDone: () => void;
  children: ReactNode;
}

function Form({ isBusy, save, onDone, children }: FrameProps) {
  const complain = useComplaint();
  return (
    <form
      className={classes.form}
      onSubmit={(event) => {
        event.preventDefault();
        save().then(onDone, complain);
      }}
    >
      {children}
      <Group gap="xs">
        <Button type="submit" size="xs" loading={isBusy}>
          Save
        </Button>
        <Button variant="default" size="xs" onClick={onDone}>
          Keep as it was
        </Button>
      </Group>
    </form>
  );
}
