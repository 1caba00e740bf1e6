/** Narrow the table: a field for any word, and a panel for everything else. */
import { Button, FocusTrap, Popover, TextInput } from '@mantine/core';
import { useDebouncedCallback } from '@mantine/hooks';
import { Suspense, useEffect, useRef, useState } from 'react';
import { Icon } from '@/components/icon';
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
  const [typed, setTyped] = useState(text);
  // What was typed is on its way into the address; anything else that comes to stand there came from outside.
  const sent = useRef<readonly string[]>([]);
  useEffect(() => {
    const isOwn = sent.current.includes(text);
    if (!isOwn || text === sent.current.at(-1)) sent.current = [];
    if (!isOwn) setTyped(text);
  }, [text]);
  const apply = useDebouncedCallback((next: string) => {
    sent.current = [...sent.current, next];
    onChange({ search: next || undefined });
  }, TYPING_REST_MS);
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
        setTyped(event.currentTarget.value);
        apply(event.currentTarget.value);
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
