/** Every other setting of a run, as the config's schema describes it. */
import { Accordion, Button, UnstyledButton } from '@mantine/core';
import { useDisclosure } from '@mantine/hooks';
import { Icon } from '@/components/icon';
import { InlineCode } from '@/components/inline-code';
import { formatPlural } from '@/lib/format';
import { GROUP_SECTIONS } from '@/lib/setting-help';
import { type SettingGroup, valueAt } from '@/lib/settings';
import type { LaunchForm } from '../use-launch-form';
import classes from './launch.module.css';
import { SettingField } from './setting-field';

interface Props {
  form: LaunchForm;
  problems: Readonly<Record<string, string>>;
  onType: (path: string, text: string | undefined) => void;
}

export function AdvancedSettings({ form, problems, onType }: Props) {
  const [isOpen, { toggle }] = useDisclosure(false);
  const { groups, defaults, typed, changed } = form;
  const isTouched = Object.keys(typed).length > 0;
  return (
    <section className="card">
      <div className={classes.advancedHead}>
        <UnstyledButton
          className={classes.advancedToggle}
          onClick={toggle}
          aria-expanded={isOpen}
          aria-controls="advanced"
        >
          <span className={classes.chevron} data-open={isOpen || undefined}>
            <Icon name="arrow" size={14} />
          </span>
          <b>Advanced settings</b>
          <span className="faint">{changed.length > 0 ? `${changed.length} changed` : 'as the preset has them'}</span>
        </UnstyledButton>
        {isTouched && (
          <Button variant="subtle" size="compact-xs" onClick={form.resetSettings}>
            Undo all changes
          </Button>
        )}
      </div>
      <div id="advanced" hidden={!isOpen}>
        {isOpen && defaults && (
          <Accordion multiple defaultValue={groups.slice(0, 1).map((group) => group.name)} order={3}>
            {groups.map((group) => {
              const touched = group.settings.filter((setting) => changed.includes(setting.path)).length;
              return (
                <Accordion.Item key={group.name} value={group.name}>
                  <Accordion.Control>
                    <span className={classes.groupHead}>
                      <b>{group.label}</b>
                      <span className="faint">
                        <InlineCode text={group.help} />
                        {tellSection(group)}
                      </span>
                      {touched > 0 && <span className={classes.touched}>{formatPlural(touched, 'change')}</span>}
                    </span>
                  </Accordion.Control>
                  <Accordion.Panel>
                    <div className={classes.settings}>
                      {group.settings.map((setting) => (
                        <SettingField
                          key={setting.path}
                          setting={setting}
                          typed={typed[setting.path]}
                          preset={valueAt(defaults, setting.path)}
                          problem={problems[setting.path]}
                          onType={(text) => onType(setting.path, text)}
                        />
                      ))}
                    </div>
                  </Accordion.Panel>
                </Accordion.Item>
              );
            })}
          </Accordion>
        )}
      </div>
    </section>
  );
}

/** Where the paper tells of a group, unless its help says so already. */
function tellSection({ name, help }: SettingGroup): string {
  const section = GROUP_SECTIONS[name];
  return section === undefined || help.includes('§') ? '' : ` Paper: ${section}.`;
}
