/** The run's Rerun recording, opened on the page. */
import { Button, SegmentedControl, Switch, useComputedColorScheme } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useRef, useState } from 'react';
import type { RunDetail, RunFile } from '@/client/schema.gen';
import { CopyButton } from '@/components/copy-button';
import { Icon } from '@/components/icon';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { formatMoment, formatSize } from '@/lib/format';
import { hasEnded } from '@/lib/states';
import { filesQuery } from '../api/run-records';
import { newestRecording, openCommand, RERUN_VERSION, versionUrl } from '../recordings';
import { TIMELINES, type Timeline, useRerunViewer } from '../use-rerun-viewer';
import classes from './rerun.module.css';

export function RerunTab({ run }: { run: RunDetail }) {
  const { data, error } = useQuery(filesQuery(run.id));
  const recording = newestRecording(data?.files);
  if (error && !data) {
    return (
      <SentencePanel urgent title="The recording cannot be shown">
        {sentence(error)}
      </SentencePanel>
    );
  }
  if (data && recording === undefined) {
    return (
      <SentencePanel title="No recording yet">
        {hasEnded(run.state)
          ? 'This run has left none. `sldr export rerun` makes one from what the store has.'
          : 'It appears after the first test, and is renewed while the run trains.'}
      </SentencePanel>
    );
  }
  return recording && <Recording recording={recording} isLive={!hasEnded(run.state)} />;
}

function Recording({ recording, isLive }: { recording: RunFile; isLive: boolean }) {
  const [isRenewed, setRenewed] = useState(true);
  const [opened, setOpened] = useState(recording);
  if (isRenewed && opened.sha256 !== recording.sha256) setOpened(recording);
  return (
    <section aria-label="Rerun" className={classes.tab}>
      <div className={classes.head}>
        <Button
          component="a"
          href={recording.url}
          download={recording.name}
          variant="default"
          size="xs"
          leftSection={<Icon name="download" size={14} />}
        >
          Download {formatSize(recording.size)}
        </Button>
        <span className={classes.command}>
          <code className="mono">{openCommand(recording)}</code>
          <CopyButton text={openCommand(recording)} label="Copy" />
        </span>
        <span className="faint">
          needs Rerun {RERUN_VERSION}: <code className="mono">pip install rerun-sdk=={RERUN_VERSION}</code>
        </span>
        {isLive && (
          <Switch
            size="xs"
            label="Open the newest while it trains"
            checked={isRenewed}
            onChange={(event) => setRenewed(event.currentTarget.checked)}
          />
        )}
      </div>
      <Viewer recording={opened.name === recording.name ? { ...opened, ticket: recording.ticket } : opened} />
    </section>
  );
}

function Viewer({ recording }: { recording: RunFile }) {
  const scheme = useComputedColorScheme('light');
  const parent = useRef<HTMLDivElement>(null);
  const url = versionUrl(recording, window.location.origin);
  const { state, problem, setTimeline } = useRerunViewer(parent, url, recording.ticket ?? '', scheme);
  const [timeline, setShown] = useState<Timeline>('env_steps');
  if (problem !== undefined) {
    return (
      <SentencePanel urgent title="Rerun cannot be shown in this browser">
        {problem} The downloaded file opens with the command above.
      </SentencePanel>
    );
  }
  return (
    <>
      <div className={classes.head}>
        <SegmentedControl
          size="xs"
          aria-label="Timeline"
          disabled={state !== 'shown'}
          value={timeline}
          onChange={(value) => {
            setShown(value as Timeline);
            setTimeline(value as Timeline);
          }}
          data={Object.entries(TIMELINES).map(([value, label]) => ({ value, label }))}
        />
        <span className="faint" role="status">
          {STATE_WORDS[state] ?? `Written ${formatMoment(recording.created_at)}.`}
        </span>
      </div>
      <div ref={parent} className={classes.viewer} data-viewer={state} />
    </>
  );
}

const STATE_WORDS: Record<string, string | undefined> = {
  loading: 'Rerun is coming: 14 MB, the first time.',
  opening: 'The recording is opening.',
};
