/** The box that selects a run; arrows go from box to box, with Shift they select on the way. */
import type { KeyboardEvent } from 'react';
import type { RunSummary } from '@/client/schema.gen';
import { runTitle } from '@/lib/run-title';
import type { Selection } from '../use-selection';
import classes from './runs.module.css';

const STEPS: Readonly<Record<string, number>> = { ArrowDown: 1, ArrowUp: -1 };

export function SelectBox({ run, selection }: { run: RunSummary; selection: Selection }) {
  const press = (event: KeyboardEvent<HTMLInputElement>): void => {
    const step = STEPS[event.key];
    if (event.key === 'Escape') selection.clear();
    if (step === undefined) return;
    event.preventDefault();
    const boxes = [...document.querySelectorAll<HTMLInputElement>('input[data-select-run]')];
    const next = boxes[boxes.indexOf(event.currentTarget) + step];
    next?.focus();
    const id = next?.dataset.selectRun;
    if (event.shiftKey && id !== undefined) {
      if (!selection.has(run.id)) selection.set(run.id, true, false);
      selection.set(id, true, true);
    }
  };
  return (
    <label className={classes.select}>
      <input
        type="checkbox"
        data-select-run={run.id}
        aria-label={`Select ${runTitle(run)}`}
        checked={selection.has(run.id)}
        onChange={(event) =>
          selection.set(run.id, event.currentTarget.checked, (event.nativeEvent as MouseEvent).shiftKey === true)
        }
        onKeyDown={press}
      />
    </label>
  );
}
