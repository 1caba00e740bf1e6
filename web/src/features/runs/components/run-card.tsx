/** One run as a card. */
import type { ComponentProps, ReactNode } from 'react';
import { AnchorLink } from '@/components/anchor-link';
import { Elapsed } from '@/components/elapsed';
import { RunProgress } from '@/components/run-progress';
import { RunThumbnail } from '@/components/run-thumbnail';
import { StateBadge } from '@/components/state-badge';
import { TagChips } from '@/components/tag-chips';
import { formatEstimate } from '@/lib/format';
import { runTitle } from '@/lib/run-title';
import { wishOf } from '@/lib/states';
import type { Line, Lines } from '../lines';
import { formatMetric, parseMetricColumn, statisticName } from '../metric-columns';
import classes from './lines.module.css';
import { Launched, Speed, Success } from './run-figures';
import { hasNote, RunNote } from './run-note';
import { SelectBox } from './select-box';

interface Props {
  line: Extract<Line, { kind: 'run' }>;
  metrics: readonly string[];
  isSelected: boolean;
  findRun: Lines['findRun'];
  onTag: (tag: string) => void;
  box: Pick<ComponentProps<typeof SelectBox>, 'isActive' | 'onSelect' | 'onFocus'>;
}

export function RunCard({ line, metrics, isSelected, findRun, onTag, box }: Props) {
  const { run } = line;
  return (
    <div className={`card ${classes.card}`} data-selected={isSelected || undefined}>
      <div className={classes.cardHead}>
        <SelectBox label={`Select ${runTitle(run)}`} isSelected={isSelected} {...box} />
        <RunThumbnail runId={run.id} version={run.state} />
        <AnchorLink to="/runs/$runId" params={{ runId: run.id }} fw={600} aria-label={runTitle(run)}>
          {run.task}
        </AnchorLink>
        <StateBadge state={run.state} wish={wishOf(run)} />
      </div>
      <div className="faint">
        {run.phase} · {run.method} · seed {run.seed} · {run.preset}
        {run.changes.length > 0 && ` · ${run.changes.join(' ')}`}
      </div>
      {run.tags.length > 0 && <TagChips tags={run.tags} onPick={onTag} />}
      {run.progress && <RunProgress progress={run.progress} state={run.state} label={`Progress of ${runTitle(run)}`} />}
      <dl className={classes.figures}>
        {run.progress && (
          <Figure name="Success">
            <Success progress={run.progress} />
          </Figure>
        )}
        {metrics.map((text, at) => (
          <MetricFigure key={text} text={text} value={line.values[at]} />
        ))}
        {run.state === 'running' && (
          <>
            <Figure name="Steps / updates per s">
              <Speed run={run} />
            </Figure>
            <Figure name="Left">{formatEstimate(run.progress?.seconds_left)}</Figure>
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
      {hasNote(run) && <RunNote run={run} findRun={findRun} />}
    </div>
  );
}

function MetricFigure({ text, value }: { text: string; value: number | null | undefined }) {
  const column = parseMetricColumn(text);
  if (column === null) return null;
  return <Figure name={`${column.name}, ${statisticName(column)}`}>{formatMetric(column.name, value)}</Figure>;
}

function Figure({ name, children }: { name: string; children: ReactNode }) {
  return (
    <div>
      <dt className="faint">{name}</dt>
      <dd className="number">{children}</dd>
    </div>
  );
}
