/** Everything that decided what this run computes, with what differs from its preset marked. */
import { useQuery } from '@tanstack/react-query';
import type { RunDetail } from '@/client/schema.gen';
import { CopyButton } from '@/components/copy-button';
import { InlineCode } from '@/components/inline-code';
import { formatPlural } from '@/lib/format';
import { choicesQuery, defaultsQuery } from '@/lib/queries';
import {
  type Config,
  differences,
  isSame,
  readSettingGroups,
  type SettingGroup,
  settingText,
  valueAt,
} from '@/lib/settings';
import classes from './run.module.css';

export function ConfigTab({ run }: { run: RunDetail }) {
  const { task, phase, method, preset } = run;
  const { data: choices } = useQuery(choicesQuery);
  const { data: defaults } = useQuery(defaultsQuery({ task, phase, method, preset }));
  const groups = choices === undefined ? [] : readSettingGroups(choices.config_schema);
  const differing = defaults === undefined ? 0 : differences(groups, run.config, defaults).length;
  return (
    <>
      <div className={classes.tabHead}>
        <span className="faint">
          {defaults &&
            (differing === 0
              ? `As the preset ${preset} has it`
              : `${formatPlural(differing, 'setting')} changed from the preset ${preset}`)}
          {' · config '}
          <span className="mono">{run.config_hash}</span>
        </span>
        <CopyButton text={JSON.stringify(run.config, null, 2)} label="Copy as JSON" />
      </div>
      <div className={classes.configGrid}>
        {groups.map((group) => (
          <Group key={group.name} group={group} config={run.config} defaults={defaults} />
        ))}
      </div>
    </>
  );
}

function Group({ group, config, defaults }: { group: SettingGroup; config: Config; defaults: Config | undefined }) {
  return (
    <section className={`card ${classes.configGroup}`} aria-label={group.label}>
      <h2>{group.label}</h2>
      <dl>
        {group.settings.map(({ path, label, help }) => {
          const value = valueAt(config, path);
          const usual = defaults === undefined ? value : valueAt(defaults, path);
          const isChanged = !isSame(value, usual);
          return (
            <div key={path} data-changed={isChanged || undefined} title={help.replaceAll('`', '')}>
              <dt>{label}</dt>
              <dd>
                <span className="mono">{settingText(value)}</span>
                {isChanged && (
                  <span className={classes.usual}>
                    <InlineCode text={`preset: \`${settingText(usual)}\``} />
                  </span>
                )}
              </dd>
            </div>
          );
        })}
      </dl>
    </section>
  );
}
