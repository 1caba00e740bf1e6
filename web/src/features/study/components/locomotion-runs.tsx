/** The locomotion runs that the study's runs take their reward from. */
import type { StudyRun } from '@/lib/studies';
import { RunRows } from './run-rows';
import classes from './study.module.css';

export function LocomotionRuns({ runs }: { runs: readonly StudyRun[] }) {
  if (runs.length === 0) return null;
  return (
    <section className={classes.part} aria-label="Locomotion runs">
      <h2 className={classes.partTitle}>Locomotion runs</h2>
      <p className="faint">Methods with SLDR take their reward from these; each is trained once and shared.</p>
      <RunRows runs={runs} nameOf={(run) => run.task} />
    </section>
  );
}
