/** One saved view: a link to it, and what renames, replaces or forgets it. */
import { ActionIcon, Button, TextInput } from '@mantine/core';
import { type FormEvent, useState } from 'react';
import type { SavedView } from '@/client/schema.gen';
import { AnchorLink } from '@/components/anchor-link';
import { Icon } from '@/components/icon';
import { OnlyFor } from '@/components/only-for';
import { readRunsSearch } from '../search';
import classes from './runs.module.css';

interface Props {
  view: SavedView;
  isCurrent: boolean;
  onRename: (name: string, onDone: () => void) => void;
  /** Let it show what is shown now. */
  onReplace: () => void;
  onDelete: () => void;
}

export function ViewRow({ view, isCurrent, onRename, onReplace, onDelete }: Props) {
  const [name, setName] = useState<string | null>(null);
  if (name !== null) {
    const rename = (event: FormEvent): void => {
      event.preventDefault();
      if (name.trim() !== '') onRename(name.trim(), () => setName(null));
    };
    return (
      <form className={classes.line} onSubmit={rename}>
        <TextInput
          size="xs"
          aria-label={`New name of ${view.name}`}
          value={name}
          onChange={(event) => setName(event.currentTarget.value)}
          data-autofocus
        />
        <Button type="submit" size="xs" variant="light">
          Rename
        </Button>
        <Button size="xs" variant="subtle" onClick={() => setName(null)}>
          Keep
        </Button>
      </form>
    );
  }
  const search = readRunsSearch(Object.fromEntries(new URLSearchParams(view.search)));
  return (
    <div className={classes.line}>
      <AnchorLink to="/" search={search} fz={13} fw={isCurrent ? 600 : undefined} aria-current={isCurrent || undefined}>
        {view.name}
      </AnchorLink>
      <OnlyFor least="operator">
        {!isCurrent && (
          <Button
            size="compact-xs"
            variant="subtle"
            aria-label={`Let ${view.name} show what is shown now`}
            title="Let it show what is shown now"
            onClick={onReplace}
          >
            Replace
          </Button>
        )}
        <Button
          size="compact-xs"
          variant="subtle"
          aria-label={`Rename ${view.name}`}
          onClick={() => setName(view.name)}
        >
          Rename
        </Button>
        <ActionIcon size="sm" variant="subtle" aria-label={`Delete the view ${view.name}`} onClick={onDelete}>
          <Icon name="trash" size={14} />
        </ActionIcon>
      </OnlyFor>
    </div>
  );
}
