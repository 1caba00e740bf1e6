/** Narrow the table: a field for any word, and a panel for everything else. */
import { Button, FocusTrap, Popover, TextInput } from '@mantine/core';
import { useDebouncedCallback } from '@mantine/hooks';
import { Suspense } from 'react';
import { Icon } from '@/components/icon';
import { useTyped } from '@/lib/use-typed';
import type { RunsFilter } from '../search';
import { FilterFields } from './lazy-parts';
import classes from './runs.module.css';

/** Rest after the last key before the search starts [ms]. */
const TYPING_REST_MS = 250;

interface Props {
  search: RunsFilter;
  onChange: (changes: RunsFilter) => void;
}

export function SearchField({ search: { search: text = '' }, onChange }: Props) {
  const { typed, type, send } = useTyped(text, (next) => onChange({ search: next || undefined }));
  const sendRested = useDebouncedCallback(send, TYPING_REST_MS);
  return (
    <TextInput
      size="xs"
      className={classes.search}
      type="search"
      aria-label="Search runs"
      placeholder="Search"
      leftSection={<Icon name="search" size={14} />}
      value={typed}
      onChange={(event) => {
        type(event.currentTarget.value);
        sendRested(event.currentTarget.value);
      }}
    />
  );
}

export function FilterPanel(props: Props) {
  return (
    <Popover position="bottom-start" shadow="md" trapFocus>
      <Popover.Target>
        <Button variant="default" size="xs">
          Filter
        </Button>
      </Popover.Target>
      <Popover.Dropdown>
        <div className={classes.choices}>
          <FocusTrap.InitialFocus />
          <Suspense fallback={null}>
            <FilterFields {...props} />
          </Suspense>
        </div>
      </Popover.Dropdown>
    </Popover>
  );
}
