/** Settings laid over the preset: one value for every run, or several to compare. */
import { Button, CloseButton } from '@mantine/core';
import { SettingField } from '@/components/setting-field';
import type { SettingRow } from '@/lib/setting-rows';
import type { Draft, StudyDraft } from '../use-draft';
import classes from './builder.module.css';

interface Props {
  form: StudyDraft;
  onChange: (changes: Partial<Draft>) => void;
}

export function SettingRows({ form, onChange }: Props) {
  const { draft, groups, problems, isVaried } = form;
  const settings = groups.flatMap((group) => group.settings);
  const replace = (place: number, row: SettingRow | undefined): void =>
    onChange({ rows: draft.rows.flatMap((old, at) => (at === place ? (row ?? []) : old)) });
  return (
    <fieldset className={classes.set}>
      <legend className={classes.legend}>Settings</legend>
      <p className="faint">
        {draft.rows.length === 0 ? 'As the preset has them. ' : ''}
        One value is set in every run; several, as in <code>0.95, 0.98</code>, are compared side by side.
      </p>
      {draft.rows.map((row, place) => (
        // biome-ignore lint/suspicious/noArrayIndexKey: rows have no other name, and two may be equal
        <div key={place} className={classes.row}>
          <SettingField
            label={`Setting ${place + 1}`}
            groups={groups}
            row={row}
            problem={problems.rows[place]}
            onChange={(changed) => replace(place, changed)}
          />
          <CloseButton size="sm" aria-label={`Remove ${row.path}`} onClick={() => replace(place, undefined)} />
        </div>
      ))}
      {!isVaried && draft.variants && draft.variants.length > 0 && (
        <p>
          Variants {draft.variants.map((variant) => `“${variant.name}”`).join(', ')} are kept as they were.{' '}
          <Button variant="subtle" size="compact-xs" onClick={() => onChange({ variants: [] })}>
            Leave them out
          </Button>
        </p>
      )}
      <Button
        variant="default"
        size="xs"
        onClick={() => onChange({ rows: [...draft.rows, { path: firstUnused(settings, draft.rows), text: '' }] })}
      >
        Add a setting
      </Button>
    </fieldset>
  );
}

function firstUnused(settings: readonly { path: string }[], rows: readonly SettingRow[]): string {
  return settings.find(({ path }) => !rows.some((row) => row.path === path))?.path ?? '';
}
