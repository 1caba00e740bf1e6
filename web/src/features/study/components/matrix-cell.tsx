/** One cell of the matrix: best success, progress, states, missing seeds. */
import { UnstyledButton } from '@mantine/core';
import { ShareBar } from '@/components/share-bar';
import { StateCounts } from '@/components/state-counts';
import { formatShare } from '@/lib/format';
import { leadingState, type StudyCell } from '@/lib/studies';
import classes from './study.module.css';

interface Props {
  cell: StudyCell;
  /** Seeds of the study. */
  seeds: number;
  isOpen: boolean;
  onToggle: () => void;
}

export function MatrixCell({ cell, seeds, isOpen, onToggle }: Props) {
  const name = [cell.task, cell.method, cell.variant].filter(Boolean).join(', ');
  return (
    <UnstyledButton className={classes.cell} aria-expanded={isOpen} data-open={isOpen || undefined} onClick={onToggle}>
      <span className="hidden">{name}: </span>
      <span className={classes.best}>
        {cell.best_success_rate === null ? (
          <span className="faint">not tested</span>
        ) : (
          <>
            <b className="number" title="Median over the tested seeds of the best test's success">
              {formatShare(cell.best_success_rate)}
            </b>
            <span className="faint number" title="Seeds that have been tested">
              {cell.tested} of {seeds}
            </span>
          </>
        )}
      </span>
      <span className="hidden">{formatShare(cell.progress)} trained</span>
      <span aria-hidden="true">
        <ShareBar share={cell.progress} state={leadingState(cell.states)} label={`Progress of ${name}`} />
      </span>
      <span className={classes.foot}>
        <StateCounts states={cell.states} />
        {cell.missing_seeds.length > 0 && (
          <span className={classes.missing}>missing: seed {cell.missing_seeds.join(', ')}</span>
        )}
      </span>
    </UnstyledButton>
  );
}
