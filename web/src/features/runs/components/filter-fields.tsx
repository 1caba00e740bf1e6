/** All that the table can be narrowed by, loaded when somebody wants to. */
import { MultiSelect, NumberInput, Switch } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { TagField } from '@/components/tag-field';
import { choicesQuery } from '@/lib/queries';
import { RUN_STATES } from '@/lib/states';
import { PHASES, type RunsFilter } from '../search';
import classes from './runs.module.css';

interface Props {
  search: RunsFilter;
  onChange: (changes: RunsFilter) => void;
}

export function FilterFields(props: Props) {
  const { search, onChange } = props;
  return (
    <>
      <Choices {...props} />
      <TagField label="Has all tags" value={search.tag ?? []} onChange={(tag) => onChange({ tag: some(tag) })} />
      <TagField
        label="Has any of the tags"
        value={search.any_tag ?? []}
        onChange={(tags) => onChange({ any_tag: some(tags) })}
      />
      <TagField
        label="Has none of the tags"
        value={search.no_tag ?? []}
        onChange={(tags) => onChange({ no_tag: some(tags) })}
      />
      <div className={classes.pair}>
        <Bound label="Seed from" value={search.seed_from} onSet={(seed_from) => onChange({ seed_from })} />
        <Bound label="Seed to" value={search.seed_to} onSet={(seed_to) => onChange({ seed_to })} />
        <Bound
          label="Success from"
          unit=" %"
          value={inPercent(search.success_from)}
          onSet={(share) => onChange({ success_from: ofPercent(share) })}
        />
        <Bound
          label="Success to"
          unit=" %"
          value={inPercent(search.success_to)}
          onSet={(share) => onChange({ success_to: ofPercent(share) })}
        />
      </div>
      <Switch
        size="xs"
        label="Deleted runs, instead of all others"
        checked={search.deleted === 'yes'}
        onChange={(event) => onChange({ deleted: event.currentTarget.checked ? 'yes' : undefined })}
      />
    </>
  );
}

function Choices({ search, onChange }: Props) {
  const { data } = useQuery(choicesQuery);
  const names = (list: readonly { name: string }[] | undefined): string[] => list?.map(({ name }) => name) ?? [];
  return (
    <>
      <Several label="State" value={search.state} names={RUN_STATES} onPick={(state) => onChange({ state })} />
      <Several label="Task" value={search.task} names={names(data?.tasks)} onPick={(task) => onChange({ task })} />
      <Several label="Phase" value={search.phase} names={PHASES} onPick={(phase) => onChange({ phase })} />
      <Several
        label="Method"
        value={search.method}
        names={names(data?.methods)}
        onPick={(method) => onChange({ method })}
      />
      <Several
        label="Preset"
        value={search.preset}
        names={names(data?.presets)}
        onPick={(preset) => onChange({ preset })}
      />
    </>
  );
}

interface SeveralProps<Name extends string> {
  label: string;
  value: readonly Name[] | undefined;
  names: readonly Name[];
  onPick: (names: readonly Name[] | undefined) => void;
}

function Several<Name extends string>({ label, value = [], names, onPick }: SeveralProps<Name>) {
  return (
    <MultiSelect
      size="xs"
      label={label}
      placeholder={value.length === 0 ? 'Any' : undefined}
      data={[...new Set([...names, ...value])]}
      value={[...value]}
      onChange={(chosen) => onPick(some(chosen as Name[]))}
      comboboxProps={{ withinPortal: false }}
      searchable
      clearable
    />
  );
}

interface BoundProps {
  label: string;
  unit?: string;
  value: number | undefined;
  onSet: (value: number | undefined) => void;
}

function Bound({ label, unit, value, onSet }: BoundProps) {
  return (
    <NumberInput
      size="xs"
      label={label}
      placeholder="Any"
      min={0}
      max={unit ? 100 : 2 ** 31 - 1}
      clampBehavior="strict"
      allowDecimal={unit !== undefined}
      suffix={unit}
      value={value ?? ''}
      onChange={(typed) => onSet(typed === '' ? undefined : Number(typed))}
      hideControls
    />
  );
}

function inPercent(share: number | undefined): number | undefined {
  return share === undefined ? undefined : Number((share * 100).toFixed(2));
}

function ofPercent(percent: number | undefined): number | undefined {
  return percent === undefined ? undefined : percent / 100;
}

function some<T>(list: readonly T[]): readonly T[] | undefined {
  return list.length === 0 ? undefined : list;
}
