/** The runs as a dense table. */
import { useNavigate } from '@tanstack/react-router';
import type { MouseEvent } from 'react';
import type { RunSummary } from '@/client/schema.gen';
import { AnchorLink } from '@/components/anchor-link';
import { RunProgress } from '@/components/run-progress';
import { RunThumbnail } from '@/components/run-thumbnail';
import { StateBadge } from '@/components/state-badge';
import { formatDuration, NOTHING } from '@/lib/format';
import { runTitle } from '@/lib/run-title';
import { wishOf } from '@/lib/states';
import { SORT_KEYS, type Sorting, type SortKey } from '../search';
import type { Selection } from '../use-selection';
import { Elapsed, Launched, Speed, Success } from './run-figures';
import { hasNote, RunNote } from './run-note';
import classes from './runs.module.css';
import { SelectBox } from './select-box';

interface Column {
  readonly name: string;
  readonly isNumber?: boolean;
  readonly help?: string;
  readonly sort?: SortKey;
}

const COLUMNS: readonly Column[] = [
  { name: 'State', sort: 'state' },
  { name: 'Task', sort: 'task' },
  { name: 'Phase' },
  { name: 'Method' },
  { name: 'Seed', isNumber: true },
  { name: 'Preset' },
  { name: 'Progress', help: 'Epoch it is in, of all epochs' },
  {
    name: 'Success',
    isNumber: true,
    help: 'Success of the newest test, and the best of all tests',
    sort: 'success',
  },
  { name: 'Speed', isNumber: true, help: 'Environment steps per second, and gradient updates per second' },
  { name: 'Time left', isNumber: true },
  { name: 'Duration', isNumber: true },
  { name: 'Launched', isNumber: true, sort: 'launched' },
];

interface Props {
  runs: readonly RunSummary[];
  selection: Selection;
  sorting: Sorting;
  onSort: (sorting: Sorting) => void;
}

export function RunsTable({ runs, selection, sorting, onSort }: Props) {
  const ids = runs.map((run) => run.id);
  const isAll = selection.ids.length === ids.length;
  return (
    <div className={`card ${classes.frame}`}>
      <table className={classes.table} aria-label="Runs">
        <thead>
          <tr>
            <th scope="col" className={classes.selectColumn}>
              <label className={classes.select}>
                <input
                  type="checkbox"
                  aria-label="Select all runs shown"
                  checked={isAll}
                  ref={(box) => {
                    if (box) box.indeterminate = !isAll && selection.ids.length > 0;
                  }}
                  onChange={() => (isAll ? selection.clear() : selection.selectAll(ids))}
                />
              </label>
            </th>
            {COLUMNS.map((column) => (
              <ColumnHead key={column.name} column={column} sorting={sorting} onSort={onSort} />
            ))}
          </tr>
        </thead>
        {runs.map((run) => (
          <RunRows key={run.id} run={run} runs={runs} selection={selection} />
        ))}
      </table>
    </div>
  );
}

interface HeadProps {
  column: Column;
  sorting: Sorting;
  onSort: (sorting: Sorting) => void;
}

function ColumnHead({ column: { name, isNumber, help, sort }, sorting, onSort }: HeadProps) {
  if (sort === undefined) {
    return (
      <th scope="col" data-number={isNumber || undefined} title={help}>
        {name}
      </th>
    );
  }
  const isSorted = sorting.sort === sort;
  const next = isSorted ? !sorting.descending : SORT_KEYS[sort];
  return (
    <th
      scope="col"
      data-number={isNumber || undefined}
      title={help}
      aria-sort={isSorted ? (sorting.descending ? 'descending' : 'ascending') : 'none'}
    >
      <button
        type="button"
        className={classes.sort}
        data-sorted={isSorted || undefined}
        onClick={() => onSort({ sort, descending: next })}
      >
        {name}
        <span aria-hidden="true">{isSorted ? (sorting.descending ? ' ↓' : ' ↑') : ' ↕'}</span>
      </button>
    </th>
  );
}

interface RowProps {
  run: RunSummary;
  runs: readonly RunSummary[];
  selection: Selection;
}

function RunRows({ run, runs, selection }: RowProps) {
  const navigate = useNavigate();
  const open = (event: MouseEvent<HTMLElement>): void => {
    const isText = window.getSelection()?.isCollapsed === false;
    if (isText || (event.target as HTMLElement).closest('a, button, label')) return;
    void navigate({ to: '/runs/$runId', params: { runId: run.id } });
  };
  const { progress } = run;
  return (
    // A mouse may use the whole row; the keyboard uses the link in it.
    // biome-ignore lint/a11y/useKeyWithClickEvents: the link in the row is the keyboard's way
    <tbody className={classes.run} onClick={open} data-run={run.id} data-selected={selection.has(run.id) || undefined}>
      <tr>
        <td className={classes.selectColumn}>
          <SelectBox run={run} selection={selection} />
        </td>
        <td>
          <StateBadge state={run.state} wish={wishOf(run)} />
        </td>
        <th scope="row">
          <RunThumbnail runId={run.id} version={run.state} />{' '}
          <AnchorLink to="/runs/$runId" params={{ runId: run.id }} fw={600} fz={13} aria-label={runTitle(run)}>
            {run.task}
          </AnchorLink>
        </th>
        <td>{run.phase}</td>
        <td>{run.method}</td>
        <td data-number>{run.seed}</td>
        <td className="faint">{run.preset}</td>
        <td className={classes.progress}>
          <RunProgress progress={progress} state={run.state} label={`Progress of ${runTitle(run)}`} />
        </td>
        <td data-number>
          <Success progress={progress} />
        </td>
        <td data-number>
          <Speed run={run} />
        </td>
        <td data-number>{run.state === 'running' ? formatDuration(progress?.seconds_left) : NOTHING}</td>
        <td data-number>
          <Elapsed run={run} />
        </td>
        <td data-number>
          <Launched run={run} />
        </td>
      </tr>
      {hasNote(run) && (
        <tr className={classes.note}>
          <td />
          <td colSpan={COLUMNS.length}>
            <RunNote run={run} runs={runs} />
          </td>
        </tr>
      )}
    </tbody>
  );
}
