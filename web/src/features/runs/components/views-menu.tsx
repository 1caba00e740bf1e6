/** Saved views: open, keep, rename, replace and forget what the table shows. */
import { Button, FocusTrap, Popover, TextInput } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useRouterState } from '@tanstack/react-router';
import { type FormEvent, useState } from 'react';
import type { SavedView } from '@/client/schema.gen';
import { OnlyFor } from '@/components/only-for';
import { useComplaint, useToast } from '@/components/toasts';
import { useChangeViews, type ViewWish, viewsQuery } from '../api/views';
import classes from './runs.module.css';
import { ViewRow } from './view-row';

/** Characters of a view's name. */
export const LONGEST_VIEW_NAME = 80;

export function ViewsMenu() {
  const { data } = useQuery(viewsQuery);
  const search = useRouterState({ select: (state) => state.location.searchStr.replace(/^\?/, '') });
  const toast = useToast();
  const complain = useComplaint();
  const changing = useChangeViews();
  // What became of it is told wherever one is by then.
  const change = (wish: ViewWish, onDone?: () => void): void => void changing.mutateAsync(wish).then(onDone, complain);
  // Views are everyone's: what one click takes from the others, another gives back.
  const replace = (view: SavedView): void =>
    change({ kind: 'replace', id: view.id, search }, () =>
      toast({
        text: `The view ${view.name} is what is shown now.`,
        undo: () => change({ kind: 'replace', id: view.id, search: view.search }),
      }),
    );
  const forget = (view: SavedView): void =>
    change({ kind: 'delete', id: view.id }, () =>
      toast({
        text: `The view ${view.name} is deleted.`,
        undo: () => change({ kind: 'save', name: view.name, search: view.search }),
      }),
    );
  const views = data?.views ?? [];
  const current = views.find((view) => view.search === search);
  return (
    <Popover position="bottom-start" shadow="md" trapFocus>
      <Popover.Target>
        <Button variant={current ? 'light' : 'default'} size="xs" title="Views that were given a name, for everyone">
          {current ? current.name : 'Views'}
        </Button>
      </Popover.Target>
      <Popover.Dropdown>
        <div className={classes.choices}>
          <FocusTrap.InitialFocus />
          {views.length === 0 && <span className="faint">No view is saved yet.</span>}
          {views.map((view) => (
            <ViewRow
              key={view.id}
              view={view}
              isCurrent={view === current}
              onRename={(name, onDone) => change({ kind: 'rename', id: view.id, name }, onDone)}
              onReplace={() => replace(view)}
              onDelete={() => forget(view)}
            />
          ))}
          {current === undefined && (
            <OnlyFor least="operator">
              <NewView onSave={(name, onDone) => change({ kind: 'save', name, search }, onDone)} />
            </OnlyFor>
          )}
        </div>
      </Popover.Dropdown>
    </Popover>
  );
}

function NewView({ onSave }: { onSave: (name: string, onDone: () => void) => void }) {
  const [name, setName] = useState('');
  const save = (event: FormEvent): void => {
    event.preventDefault();
    if (name.trim() !== '') onSave(name.trim(), () => setName(''));
  };
  return (
    <form className={classes.line} onSubmit={save}>
      <TextInput
        size="xs"
        aria-label="Name of the view"
        placeholder="Name for what is shown now"
        maxLength={LONGEST_VIEW_NAME}
        value={name}
        onChange={(event) => setName(event.currentTarget.value)}
      />
      <Button type="submit" size="xs" variant="light" disabled={name.trim() === ''}>
        Save
      </Button>
    </form>
  );
}
