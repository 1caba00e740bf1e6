/** One setting: a list of words, a switch, or a text that is read as numbers. */
import { Select, Switch, TextInput, UnstyledButton } from '@mantine/core';
import { EquationLine } from '@/components/equation-line';
import { InlineCode } from '@/components/inline-code';
import { SETTING_EQUATIONS } from '@/lib/setting-help';
import { describeBounds, type Setting, type SettingValue, settingText } from '@/lib/settings';
import classes from './launch.module.css';

interface Props {
  setting: Setting;
  /** What was typed, if anything. */
  typed: string | undefined;
  /** The preset's value. */
  preset: SettingValue;
  problem?: string;
  onType: (text: string | undefined) => void;
}

export function SettingField({ setting, typed, preset, problem, onType }: Props) {
  const presetText = settingText(preset);
  const text = typed ?? presetText;
  const isChanged = typed !== undefined && typed.trim() !== presetText;
  const shared = {
    label: setting.label,
    description: <Help setting={setting} />,
    error: problem,
    size: 'xs' as const,
    name: setting.path,
  };
  return (
    <div className={classes.setting} data-changed={isChanged || undefined}>
      {setting.kind === 'choice' ? (
        <Select {...shared} data={setting.options} value={text} onChange={(word) => onType(word ?? undefined)} />
      ) : setting.kind === 'flag' ? (
        <Switch
          {...shared}
          checked={text === 'true'}
          onChange={(event) => onType(String(event.currentTarget.checked))}
        />
      ) : (
        <TextInput
          {...shared}
          value={text}
          inputMode={setting.kind === 'integer' ? 'numeric' : undefined}
          onChange={(event) => onType(event.currentTarget.value)}
        />
      )}
      {isChanged && (
        <UnstyledButton className={classes.undo} onClick={() => onType(undefined)} aria-label={`Undo ${setting.label}`}>
          Back to {presetText || 'empty'}
        </UnstyledButton>
      )}
    </div>
  );
}

function Help({ setting }: { setting: Setting }) {
  const isNumeric = setting.kind === 'integer' || setting.kind === 'number' || setting.kind === 'integers';
  const equation = SETTING_EQUATIONS[setting.path];
  const bounds = isNumeric ? describeBounds(setting) : '';
  return (
    <>
      <InlineCode text={setting.help} />
      {bounds && <span className={classes.bounds}> {bounds}</span>}
      {equation && <EquationLine name={equation} />}
    </>
  );
}
