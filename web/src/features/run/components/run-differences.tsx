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
  const switches = switchesOf(run, usesSldr, defaults);
  const others = differences(groups, run.config, defaults).filter(
    ({ setting }) => !switches.some(({ path }) => path === setting.path),
  );
  return (
    <section className={`card ${classes.panel}`} aria-label="What differs">
      <h2>Switches</h2>
      <dl className={classes.list}>
        {switches.map(({ path, label, text, usual }) => (
          <Item key={path} path={path} label={label} text={text} usual={usual} />
        ))}
      </dl>
      <h2>Changed from {preset}</h2>
      {others.length > 0 ? <Changed changed={others} /> : <p className="faint">no other setting</p>}
    </section>
  );
}

function Changed({ changed }: { changed: readonly Difference[] }) {
  return (
    <dl className={classes.list}>
      {changed.map(({ setting: { path, label }, value, usual }) => (
        <Item key={path} path={path} label={label} text={settingText(value)} usual={settingText(usual) || 'empty'} />
      ))}
    </dl>
  );
}

interface ItemProps {
  path: string;
  label: string;
  text: string;
  /** How the preset has it, where that is otherwise. */
  usual: string | undefined;
}

function Item({ path, label, text, usual }: ItemProps) {
  return (
    <div data-changed={usual !== undefined || undefined} title={path}>
      <dt>{label}</dt>
      <dd>
        {text}
        {usual !== undefined && <span className="faint"> was {usual}</span>}
      </dd>
    </div>
  );
}
