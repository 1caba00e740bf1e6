/** Which run this is, how it stands, and what can be done with it. */
import { Button } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import type { RunDetail } from '@/client/schema.gen';
import { AnchorLink, ButtonLink } from '@/components/anchor-link';
import { Freshness } from '@/components/freshness';
import { Icon } from '@/components/icon';
import { OnlyFor } from '@/components/only-for';
import { Reason } from '@/components/reason';
import { RunThumbnail } from '@/components/run-thumbnail';
import { StateBadge } from '@/components/state-badge';
import { formatMoment } from '@/lib/format';
import { hasEnded, wishOf } from '@/lib/states';
import { filesQuery } from '../api/run-records';
import { newestRecording, openCommand } from '../recordings';
import classes from './run.module.css';
import { RunActions } from './run-actions';
import { RunFigures } from './run-figures';
import { RunLabels } from './run-labels';

export function RunHeader({ run, updatedAt }: { run: RunDetail; updatedAt: number }) {
  return (
    <header className={classes.header}>
      <div className="page-head">
        <RunThumbnail runId={run.id} version={`${run.state}-${run.progress?.epoch ?? 0}`} width={72} />
        <h1>{run.task}</h1>
        <StateBadge state={run.state} wish={wishOf(run)} />
        {!hasEnded(run.state) && <Freshness updatedAt={updatedAt} />}
        <span className={classes.actions}>
          {run.has_recording && <RecordingButton runId={run.id} />}
          <OnlyFor least="operator">
            <ButtonLink
              to="/launch"
              search={{
                task: run.task,
                phase: run.phase,
                method: run.method,
                preset: run.preset,
                seeds: String(run.seed),
                from: run.id,
              }}
              variant="default"
              size="xs"
            >
              Launch again
            </ButtonLink>
            <RunActions run={run} />
          </OnlyFor>
        </span>
      </div>
      {run.deleted_at !== null && (
        <p className={classes.deleted} role="status">
          This run was deleted {formatMoment(run.deleted_at)} and stands in no list. Nothing is lost: restore it to have
          it back as it was.
        </p>
      )}
      <Standing run={run} />
      <RunLabels run={run} />
      <RunFigures run={run} />
    </header>
  );
}

function Standing({ run }: { run: RunDetail }) {
  return (
    <p className={classes.notes}>
      <span className="faint">
        {run.phase} · {run.method} · seed {run.seed} · preset {run.preset}
        {run.attempt > 1 && ` · attempt ${run.attempt}`}
        {run.priority !== 0 && ` · priority ${run.priority}`}
        {run.gate_waived && ' · released below its gate'}
      </span>
      {run.reason !== null && (
        <span className={classes.reason} data-state={run.state} role={run.state === 'failed' ? 'alert' : undefined}>
          <Reason text={run.reason} runIds={run.needs} />
        </span>
      )}
      {run.state !== 'blocked' &&
        run.needs.map((id) => (
          <span key={id} className="faint">
            {'Learns from '}
            <AnchorLink to="/runs/$runId" params={{ runId: id }} fz="inherit">
              {run.needs.length > 1 ? `its locomotion run ${id}` : 'its locomotion run'}
            </AnchorLink>
          </span>
        ))}
    </p>
  );
}

function RecordingButton({ runId }: { runId: string }) {
  const { data } = useQuery(filesQuery(runId));
  const recording = newestRecording(data?.files);
  if (recording === undefined) return null;
  return (
    <Button
      component="a"
      href={recording.url}
      download={recording.name}
      variant="default"
      size="xs"
      leftSection={<Icon name="download" size={14} />}
      title={`Opens with: ${openCommand(recording)}`}
    >
      Rerun recording
    </Button>
  );
}
