/** A titled part of a page on a surface of its own. */
import { type ReactNode, useId } from 'react';
import classes from './card-section.module.css';

interface Props {
  title: string;
  /** What it is for, in a sentence. */
  note?: ReactNode;
  children: ReactNode;
}

export function CardSection({ title, note, children }: Props) {
  const id = useId();
  return (
    <section className={`card ${classes.section}`} aria-labelledby={id}>
      <h2 id={id} className={classes.title}>
        {title}
      </h2>
      {note && <p className={`faint ${classes.note}`}>{note}</p>}
      {children}
    </section>
  );
}
