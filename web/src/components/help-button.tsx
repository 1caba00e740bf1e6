/** A small question mark that opens a few lines of help; keyboard and screen reader find it by what it is about. */
import { Popover } from '@mantine/core';
import type { ReactNode } from 'react';
import classes from './help-button.module.css';

interface Props {
  about: string;
  children: ReactNode;
}

export function HelpButton({ about, children }: Props) {
  return (
    <Popover width={380} position="bottom-end" shadow="md" withArrow trapFocus returnFocus>
      <Popover.Target>
        <button type="button" className={classes.button} aria-label={`What ${about} does`}>
          ?
        </button>
      </Popover.Target>
      <Popover.Dropdown className={classes.help} aria-label={`What ${about} does`} tabIndex={-1}>
        {children}
      </Popover.Dropdown>
    </Popover>
  );
}
