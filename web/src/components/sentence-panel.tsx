/** One clear sentence where something is missing or went wrong, and what to do next. */
import type { ReactNode } from 'react';
import classes from './sentence-panel.module.css';

interface Props {
  title: string;
  children?: ReactNode;
  /** What can be done about it: buttons or links. */
  actions?: ReactNode;
  /** Whether it is an error, to be announced at once. */
  urgent?: boolean;
}

export function SentencePanel({ title, children, actions, urgent = false }: Props) {
  return (
    <section className={classes.panel} role={urgent ? 'alert' : undefined} data-urgent={urgent || undefined}>
      <h2 className={classes.title}>{title}</h2>
      {children && <div className={classes.text}>{children}</div>}
      {actions && <div className={classes.actions}>{actions}</div>}
    </section>
  );
}
