/** Which runs are compared. */
import { MultiSelect, Select } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { choicesQuery } from '@/lib/queries';
import { type CompareSearch, joined, partsOf } from '../search';
import classes from './controls.module.css';

interface Props {
  search: CompareSearch;
  onShow: (changes: CompareSearch) => void;
}

export function CompareFilters({ search, onShow }: Props) {
  const { data: choices } = useQuery(choicesQuery);
  return (
    <search className={classes.row} aria-label="Which runs are compared">
      <Several
        label="Tasks"
        names={choices?.tasks.map(({ name }) => name)}
        value={search.tasks}
        onPick={(tasks) => onShow({ tasks })}
      />
      <Several
        label="Methods"
        names={choices?.methods.map(({ name }) => name)}
        value={search.methods}
        onPick={(methods) => onShow({ methods, pin: undefined })}
      />
      <Select
        size="xs"
        w={140}
        aria-label="Phase"
        data={[...(choices?.phases ?? [])]}
        value={search.phase ?? 'manipulation'}
        onChange={(phase) => onShow({ phase: phase === 'locomotion' ? phase : undefined, pin: undefined })}
      />
      <Select
        size="xs"
        w={130}
        aria-label="Preset"
        placeholder="Any preset"
        clearable
        allowDeselect
        data={choices?.presets.map(({ name }) => name) ?? []}
        value={search.preset ?? null}
        onChange={(preset) => onShow({ preset: preset ?? undefined })}
      />
    </search>
  );
}

interface SeveralProps {
  label: string;
  names: readonly string[] | undefined;
  value: string | undefined;
  onPick: (value: string | undefined) => void;
}

function Several({ label, names, value, onPick }: SeveralProps) {
  const picked = partsOf(value);
  return (
    <MultiSelect
      size="xs"
      className={classes.several}
      aria-label={label}
      placeholder={picked.length === 0 ? `All ${label.toLowerCase()}` : undefined}
      data={[...(names ?? picked)]}
      value={[...picked]}
      onChange={(next) => onPick(joined(next))}
      clearable
      searchable
    />
  );
}
