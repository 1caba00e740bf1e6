/** One cell of a run, by the key of its column. */
import type { RunSummary } from '@/client/schema.gen';
import { AnchorLink } from '@/components/anchor-link';
import { Elapsed } from '@/components/elapsed';
import { RunProgress } from '@/components/run-progress';
import { RunThumbnail } from '@/components/run-thumbnail';
import { StateBadge } from '@/components/state-badge';
import { TagChips } from '@/components/tag-chips';
import { formatEstimate, NOTHING } from '@/lib/format';
import { runTitle } from '@/lib/run-title';
import { wishOf } from '@/lib/states';
import { BUILT_INS, type BuiltIn } from '../columns';
import classes from './lines.module.css';
import { Launched, Speed, Success } from './run-figures';

/** Fits a line of the table [px]. */
const THUMBNAIL_WIDTH = 36;

/** Columns that few look for. */
const FAINT: ReadonlySet<BuiltIn> = new Set(['preset', 'changes']);

interface Props {
  column: BuiltIn;
  run: RunSummary;
  onTag: (tag: string) => void;
}

export function RunCell({ column, run, onTag }: Props) {
  if (column === 'task') {
    return (
      <th scope="row">
        <RunThumbnail runId={run.id} version={run.state} width={THUMBNAIL_WIDTH} />{' '}
        <AnchorLink to="/runs/$runId" params={{ runId: run.id }} fw={600} fz={13} aria-label={runTitle(run)}>
          {run.task}
        </AnchorLink>
      </th>
    );
  }
  return (
    <td data-number={BUILT_INS[column].isNumber || undefined} className={FAINT.has(column) ? 'faint' : undefined}>
      {contentOf(column, run, onTag)}
    </td>
  );
}

function contentOf(column: Exclude<BuiltIn, 'task'>, run: RunSummary, onTag: Props['onTag']) {
  switch (column) {
    case 'state':
      return <StateBadge state={run.state} wish={wishOf(run)} />;
    case 'method':
      return <Method run={run} />;
    case 'changes':
      return <span title={run.changes.join('\n')}>{run.changes.map(withoutGroup).join(' ')}</span>;
    case 'phase':
    case 'seed':
    case 'preset':
      return run[column];
    case 'tags':
      return run.tags.length === 0 ? null : <TagChips tags={run.tags} onPick={onTag} className={classes.tags} />;
    case 'progress':
      return <RunProgress progress={run.progress} state={run.state} label={`Progress of ${runTitle(run)}`} />;
    case 'success':
      return <Success progress={run.progress} />;
    case 'speed':
      return <Speed run={run} />;
    case 'left':
      return run.state === 'running' ? formatEstimate(run.progress?.seconds_left) : NOTHING;
    case 'duration':
      return <Elapsed run={run} />;
    case 'launched':
      return <Launched run={run} />;
  }
}

/** The method, and how many settings are not as the preset has them: runs of a sweep are else all alike. */
function Method({ run }: { run: RunSummary }) {
  if (run.changes.length === 0) return run.method;
  return (
    <span title={run.changes.join('\n')}>
      {run.method} <span aria-hidden="true" className={classes.changed}>{`±${run.changes.length} `}</span>
      <span className="hidden">with {run.changes.join(', ')}</span>
    </span>
  );
}

/** `learning_rate=0.0003` of `agent.learning_rate=0.0003`: columns are narrow, and the whole is in the title. */
function withoutGroup(change: string): string {
  return change.replace(/^[^=]*\./, '');
}
