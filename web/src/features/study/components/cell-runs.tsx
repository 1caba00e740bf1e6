/** The runs of the open cell, seed by seed. */
import type { StudyCell } from '@/lib/studies';
import { RunRows } from './run-rows';
import classes from './study.module.css';

export function CellRuns({ cell }: { cell: StudyCell }) {
  const name = [cell.task, cell.method, cell.variant].filter(Boolean).join(', ');
  return (
    <section className={classes.part} aria-label={`Runs of ${name}`}>
      <h2 className={classes.partTitle}>{name}</h2>
      {cell.runs.length > 0 ? (
        <RunRows runs={cell.runs} nameOf={(run) => `Seed ${run.seed}`} />
      ) : (
        <p className="faint">No run stands here. “Fill missing” queues one for each seed.</p>
      )}
    </section>
  );
}
