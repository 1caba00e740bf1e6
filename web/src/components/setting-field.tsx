/** One setting that is chosen, and its values as they are typed. */
import { Select, TextInput } from '@mantine/core';
import { EquationLine } from '@/components/equation-line';
import { InlineCode } from '@/components/inline-code';
import { SETTING_EQUATIONS } from '@/lib/setting-help';
import type { SettingRow } from '@/lib/setting-rows';
import type { SettingGroup } from '@/lib/settings';

interface Props {
  /** What a screen reader calls the choice of the setting. */
  label: string;
  groups: readonly SettingGroup[];
  row: SettingRow;
  problem?: string;
  onChange: (row: SettingRow) => void;
}

export function SettingField({ label, groups, row, problem, onChange }: Props) {
  const setting = groups.flatMap((group) => group.settings).find(({ path }) => path === row.path);
  return (
    <>
      <Select
        size="xs"
        aria-label={label}
        searchable
        data={groups.map((group) => ({
          group: group.label,
          items: group.settings.map(({ path }) => ({ value: path, label: path })),
        }))}
        value={row.path}
        onChange={(path) => path && onChange({ path, text: '' })}
      />
      <TextInput
        size="xs"
        aria-label={`Values of ${row.path}`}
        placeholder={setting?.kind === 'integers' ? '64, 64 | 128, 128' : 'a value, or several'}
        inputWrapperOrder={['input', 'description', 'error']}
        description={setting && <Help {...setting} />}
        value={row.text}
        error={problem}
        onChange={(event) => onChange({ ...row, text: event.currentTarget.value })}
      />
    </>
  );
}

function Help({ path, help }: { path: string; help: string }) {
  const equation = SETTING_EQUATIONS[path];
  return (
    <>
      <InlineCode text={help} />
      {equation && <EquationLine name={equation} />}
    </>
  );
}
