/** The runs as a dense table. */
import { useNavigate } from '@tanstack/react-router';
import type { MouseEvent } from 'react';
import type { RunSummary } from '@/client/schema.gen';
import { AnchorLink } from '@/components/anchor-link';
import { RunProgress } from '@/components/run-progress';
import { StateBadge } from '@/components/state-badge';
import { formatDuration, NOTHING } from '@/lib/format';
import { runTitle } from '@/lib/run-title';
import { Elapsed, Speed, Started, Success } from './run-figures';
import { hasNote, RunNote } from './run-note';
import classes from './runs.module.css';

const COLUMNS: readonly { name: string; isNumber?: boolean; help?: string }[] = [
  { name: 'State' },
  { name: 'Task' },
  { name: 'Phase' },
  { name: 'Method' },
  { name: 'Seed', isNumber: true },
  { name: 'Preset' },
  { name: 'Progress', help: 'Epoch it is in, of all epochs' },
  { name: 'Success', isNumber: true, help: 'Success of the newest test, and the best of all tests' },
  { name: 'Speed', isNumber: true, help: 'Environment steps per second, and gradient updates per second' },
  { name: 'Time left', isNumber: true },
  { name: 'Duration', isNumber: true },
  { name: 'Started', isNumber: true },
];

export function RunsTable({ runs }: { runs: readonly RunSummary[] }) {
  return (
    <div className={`card ${classes.frame}`}>
      <table className={classes.table} aria-label="Runs">
        <thead>
          <tr>
            {COLUMNS.map(({ name, isNumber, help }) => (
              <th key={name} scope="col" data-number={isNumber || undefined} title={help}>
                {name}
              </th>
            ))}
          </tr>
        </thead>
        {runs.map((run) => (
          <RunRows key={run.id} run={run} runs={runs} />
        ))}
      </table>
    </div>
  );
}

function RunRows({ run, runs }: { run: RunSummary; runs: readonly RunSummary[] }) {
  const navigate = useNavigate();
  const open = (event: MouseEvent<HTMLElement>): void => {
    const isText = window.getSelection()?.isCollapsed === false;
    if (isText || (event.target as HTMLElement).closest('a, button')) return;
    void navigate({ to: '/runs/$runId', params: { runId: run.id } });
  };
  const { progress } = run;
  return (
    // A mouse may use the whole row; the keyboard uses the link in it.
    // biome-ignore lint/a11y/useKeyWithClickEvents: the link in the row is the keyboard's way
    <tbody className={classes.run} onClick={open} data-run={run.id}>
      <tr>
        <td>
          <StateBadge state={run.state} ending={run.state === 'running' && run.cancel_requested} />
        </td>
        <th scope="row">
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
          <Started run={run} />
        </td>
      </tr>
      {hasNote(run) && (
        <tr className={classes.note}>
          <td colSpan={COLUMNS.length}>
            <RunNote run={run} runs={runs} />
          </td>
        </tr>
      )}
    </tbody>
  );
}
