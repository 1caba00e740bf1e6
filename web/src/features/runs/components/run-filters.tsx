/** Narrow the runs table by state, task, phase, method, or any word. */
import { Button, Select, Switch, TextInput } from '@mantine/core';
import { useDebouncedCallback } from '@mantine/hooks';
import { useQuery } from '@tanstack/react-query';
import { useState } from 'react';
import { Icon } from '@/components/icon';
import { choicesQuery } from '@/lib/queries';
import { RUN_STATES } from '@/lib/states';
import { isNarrowed, type RunsSearch, SORT_KEYS, type SortKey, searchOf, sortingOf } from '../search';
import classes from './runs.module.css';

/** Rest after the last key before the search starts [ms]. */
const TYPING_REST_MS = 250;

const SORT_NAMES: Record<SortKey, string> = {
  launched: 'By launch',
  state: 'By state',
  success: 'By success',
  task: 'By task',
};

interface Props {
  search: RunsSearch;
  /** Whether there is a table, whose heads sort it; cards need a field for that. */
  hasTable: boolean;
  onChange: (changes: RunsSearch) => void;
}

export function RunFilters({ search, hasTable, onChange }: Props) {
  const { data: choices } = useQuery(choicesQuery);
  const isActive = isNarrowed(search);
  // A new search field for each clearing, as it holds what was typed.
  const [clearings, setClearings] = useState(0);
  return (
    <search className={classes.filters}>
      <SearchField key={clearings} text={search.search ?? ''} onChange={onChange} />
      <Filter
        label="State"
        value={search.state}
        names={RUN_STATES}
        onPick={(state) => onChange({ state: state as RunsSearch['state'] })}
      />
      <Filter
        label="Task"
        value={search.task}
        names={choices?.tasks.map((task) => task.name)}
        onPick={(task) => onChange({ task })}
      />
      <Filter
        label="Phase"
        value={search.phase}
        names={choices?.phases}
        onPick={(phase) => onChange({ phase: phase as RunsSearch['phase'] })}
      />
      <Filter
        label="Method"
        value={search.method}
        names={choices?.methods.map((method) => method.name)}
        onPick={(method) => onChange({ method })}
      />
      {!hasTable && <SortField search={search} onChange={onChange} />}
      <Switch
        size="xs"
        label="Deleted"
        checked={search.deleted === 'yes'}
        onChange={(event) => onChange({ deleted: event.currentTarget.checked ? 'yes' : undefined })}
      />
      {isActive && (
        <Button
          variant="subtle"
          size="compact-sm"
          onClick={() => {
            setClearings(clearings + 1);
            onChange({ state: undefined, task: undefined, phase: undefined, method: undefined, search: undefined });
          }}
        >
          Clear
        </Button>
      )}
    </search>
  );
}

function SortField({ search, onChange }: Pick<Props, 'search' | 'onChange'>) {
  const { sort } = sortingOf(search);
  return (
    <Select
      size="xs"
      className={classes.filter}
      aria-label="Sort by"
      data={Object.entries(SORT_NAMES).map(([value, label]) => ({ value, label }))}
      value={sort}
      onChange={(key) => key && onChange(searchOf({ sort: key as SortKey, descending: SORT_KEYS[key as SortKey] }))}
    />
  );
}

function SearchField({ text, onChange }: { text: string; onChange: Props['onChange'] }) {
  const [typed, setTyped] = useState(text);
  const apply = useDebouncedCallback((next: string) => onChange({ search: next || undefined }), TYPING_REST_MS);
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

interface FilterProps {
  label: string;
  value: string | undefined;
  names: readonly string[] | undefined;
  onPick: (name: string | undefined) => void;
}

function Filter({ label, value, names = [], onPick }: FilterProps) {
  const data = value !== undefined && !names.includes(value) ? [...names, value] : [...names];
  return (
    <Select
      size="xs"
      className={classes.filter}
      aria-label={label}
      placeholder={`Any ${label.toLowerCase()}`}
      data={data}
      value={value ?? null}
      onChange={(name) => onPick(name ?? undefined)}
      clearable
    />
  );
}
