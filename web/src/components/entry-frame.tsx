/** What surrounds the pages before somebody is signed in. */
import type { ReactNode } from 'react';
import classes from './entry-frame.module.css';

export function EntryFrame({ title, children }: { title: string; children: ReactNode }) {
  return (
    <div className={classes.place}>
      <title>{`${title} · SLDR`}</title>
      <section className={`card ${classes.card}`}>
        <img src="/icon.svg" alt="" width={32} height={32} />
        <h1 className={classes.title}>{title}</h1>
        {children}
      </section>
    </div>
  );
}
