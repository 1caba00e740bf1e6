/** What is special about this run: settings changed from its preset, and how the ablation switches stand. */
import { useQuery } from '@tanstack/react-query';
import { useMemo } from 'react';
import type { RunDetail } from '@/client/schema.gen';
import { choicesQuery, defaultsQuery } from '@/lib/queries';
import { type Difference, differences, readSettingGroups, settingText } from '@/lib/settings';
import { switchesOf } from '../switches';
import classes from './differences.module.css';

export function RunDifferences({ run }: { run: RunDetail }) {
  const { task, phase, method, preset } = run;
  const { data: choices } = useQuery(choicesQuery);
  const { data: defaults } = useQuery(defaultsQuery({ task, phase, method, preset }));
  const groups = useMemo(() => (choices ? readSettingGroups(choices.config_schema) : []), [choices]);
  if (choices === undefined || defaults === undefined) return null;
  const usesSldr =
    phase === 'manipulation' && choices.methods.some((spec) => spec.name === method && spec.needs_locomotion);
  return (
    <section className={`card ${classes.panel}`} aria-label="What differs">
      <h2>Changed from {preset}</h2>
      <Changed changed={differences(groups, run.config, defaults)} />
      <h2>Switches</h2>
      <dl className={classes.list}>
        {switchesOf(run, usesSldr, defaults).map(({ path, label, text, isChanged }) => (
          <div key={path} data-changed={isChanged || undefined} title={path}>
            <dt>{label}</dt>
            <dd>{text}</dd>
          </div>
        ))}
      </dl>
    </section>
  );
}

function Changed({ changed }: { changed: readonly Difference[] }) {
  if (changed.length === 0) return <p className="faint">nothing</p>;
  return (
    <dl className={classes.list}>
      {changed.map(({ setting, value, usual }) => (
        <div key={setting.path} data-changed title={setting.path}>
          <dt>{setting.label}</dt>
          <dd>
            {settingText(value)} <span className="faint">was {settingText(usual) || 'empty'}</span>
          </dd>
        </div>
      ))}
    </dl>
  );
}
