/** Choose any number of tasks or methods. */
import { Button, Checkbox } from '@mantine/core';
import { type ReactNode, useId } from 'react';
import classes from './builder.module.css';

interface Props {
  legend: string;
  known: readonly { name: string; summary: string; help?: ReactNode }[];
  chosen: readonly string[];
  problem: string | undefined;
  onChange: (names: string[]) => void;
}

export function NameChecks({ legend, known, chosen, problem, onChange }: Props) {
  const id = useId();
  const toggle = (name: string): void =>
    onChange(chosen.includes(name) ? chosen.filter((other) => other !== name) : [...chosen, name]);
  return (
    <fieldset className={classes.set} aria-describedby={problem ? id : undefined}>
      <legend className={classes.legend}>
        {legend}{' '}
        <span className="faint number">
          {chosen.length} of {known.length}
        </span>
      </legend>
      <div className={classes.checks}>
        {known.map(({ name, summary, help }) => (
          <span key={name} className={classes.check}>
            <Checkbox
              size="xs"
              label={name}
              title={summary}
              checked={chosen.includes(name)}
              onChange={() => toggle(name)}
            />
            {help}
          </span>
        ))}
      </div>
      <div className={classes.chips}>
        <Button variant="subtle" size="compact-xs" onClick={() => onChange(known.map(({ name }) => name))}>
          All {legend.toLowerCase()}
        </Button>
        <Button variant="subtle" size="compact-xs" onClick={() => onChange([])}>
          None
        </Button>
      </div>
      {problem && (
        <p id={id} className="problem">
          {problem}
        </p>
      )}
    </fieldset>
  );
}
