/** The runs as cards, for narrow screens. */
import type { RunSummary } from '@/client/schema.gen';
import { AnchorLink } from '@/components/anchor-link';
import { RunProgress } from '@/components/run-progress';
import { RunThumbnail } from '@/components/run-thumbnail';
import { StateBadge } from '@/components/state-badge';
import { formatDuration } from '@/lib/format';
import { runTitle } from '@/lib/run-title';
import { wishOf } from '@/lib/states';
import type { Selection } from '../use-selection';
import { Elapsed, Launched, Speed, Success } from './run-figures';
import { hasNote, RunNote } from './run-note';
import classes from './runs.module.css';
import { SelectBox } from './select-box';

export function RunCards({ runs, selection }: { runs: readonly RunSummary[]; selection: Selection }) {
  return (
    <ul className={classes.cards} aria-label="Runs">
      {runs.map((run) => (
        <li
          key={run.id}
          className={`card ${classes.card}`}
          data-run={run.id}
          data-selected={selection.has(run.id) || undefined}
        >
          <div className={classes.cardHead}>
            <SelectBox run={run} selection={selection} />
            <RunThumbnail runId={run.id} version={run.state} />
            <AnchorLink to="/runs/$runId" params={{ runId: run.id }} fw={600} aria-label={runTitle(run)}>
              {run.task}
            </AnchorLink>
            <StateBadge state={run.state} wish={wishOf(run)} />
          </div>
          <div className="faint">
            {run.phase} · {run.method} · seed {run.seed} · {run.preset}
          </div>
          {run.progress && (
            <RunProgress progress={run.progress} state={run.state} label={`Progress of ${runTitle(run)}`} />
          )}
          <dl className={classes.figures}>
            {run.progress && (
              <Figure name="Success">
                <Success progress={run.progress} />
              </Figure>
            )}
            {run.state === 'running' && (
              <>
                <Figure name="Steps / updates per s">
                  <Speed run={run} />
                </Figure>
                <Figure name="Left">{formatDuration(run.progress?.seconds_left)}</Figure>
              </>
            )}
            {run.started_at && (
              <Figure name="Duration">
                <Elapsed run={run} />
              </Figure>
            )}
            <Figure name="Launched">
              <Launched run={run} />
            </Figure>
          </dl>
          {hasNote(run) && <RunNote run={run} runs={runs} />}
        </li>
      ))}
    </ul>
  );
}

function Figure({ name, children }: { name: string; children: React.ReactNode }) {
  return (
    <div>
      <dt className="faint">{name}</dt>
      <dd className="number">{children}</dd>
    </div>
  );
}
