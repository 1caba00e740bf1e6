/** The commands of the palette, by group. */
import type { Ref } from 'react';
import type { Command, CommandGroup } from './commands';
import classes from './palette.module.css';

interface Props {
  id: string;
  groups: readonly CommandGroup[];
  /** Place of the marked command among all. */
  at: number;
  ref: Ref<HTMLDivElement>;
  onMark: (at: number) => void;
  onPerform: (command: Command) => void;
}

export function CommandList({ id, groups, at, ref, onMark, onPerform }: Props) {
  let place = -1;
  return (
    <div id={`${id}-list`} ref={ref} role="listbox" aria-label="Commands" className={classes.list} tabIndex={-1}>
      {groups.map(({ title, commands }) => (
        // biome-ignore lint/a11y/useSemanticElements: a fieldset may not stand in a listbox
        <div key={title} role="group" aria-label={title}>
          <div className={classes.title} aria-hidden>
            {title}
          </div>
          {commands.map((command) => {
            place += 1;
            const here = place;
            return (
              // biome-ignore lint/a11y/useKeyWithClickEvents: the keys are those of the field above, which keeps the focus
              // biome-ignore lint/a11y/useFocusableInteractive: as in every combobox the field names the marked option
              <div
                key={command.id}
                id={`${id}-${here}`}
                role="option"
                aria-selected={here === at}
                className={classes.command}
                data-at={here}
                onMouseMove={() => onMark(here)}
                onMouseDown={(event) => event.preventDefault()}
                onClick={() => onPerform(command)}
              >
                <span className={classes.label}>{command.label}</span>
                {command.note && <span className={classes.note}>{command.note}</span>}
              </div>
            );
          })}
        </div>
      ))}
    </div>
  );
}
