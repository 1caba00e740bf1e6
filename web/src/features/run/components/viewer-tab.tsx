/** Watch the newest policy in 3D. */
import { Button, Loader, useComputedColorScheme } from '@mantine/core';
import type { RunDetail } from '@/client/schema.gen';
import { Icon } from '@/components/icon';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { useViewerSession } from '../api/viewer-session';
import classes from './run.module.css';

export function ViewerTab({ run }: { run: RunDetail }) {
  const scheme = useComputedColorScheme('light');
  const { session, isOpening, error, open, close } = useViewerSession(run.id);
  const again = <Button onClick={open}>Try again</Button>;
  if (error) {
    return (
      <SentencePanel urgent title="The 3D view cannot be shown" actions={again}>
        {sentence(error)}
      </SentencePanel>
    );
  }
  if (session?.state === 'failed' || session?.state === 'ended') {
    return (
      <SentencePanel
        urgent={session.state === 'failed'}
        title={session.state === 'failed' ? 'The 3D view failed' : 'The 3D view has ended'}
        actions={again}
      >
        {session.message}
      </SentencePanel>
    );
  }
  if (session?.state === 'ready' && session.url !== null) {
    return (
      <section aria-label="3D view">
        <div className={classes.viewerHead}>
          <span className="faint">{session.message}</span>
          <Button variant="default" size="compact-xs" onClick={close}>
            Close
          </Button>
        </div>
        <iframe
          className={classes.viewer}
          title="3D view of the newest policy"
          src={scheme === 'dark' ? `${session.url}?darkMode` : session.url}
          sandbox="allow-scripts allow-same-origin allow-downloads"
          allow="fullscreen"
        />
      </section>
    );
  }
  if (session || isOpening) {
    return (
      <SentencePanel title="The 3D view is starting">
        <Loader size="sm" mt="sm" mx="auto" display="block" aria-hidden />
        <p role="status">The newest policy is being loaded into its scene; this takes a few seconds.</p>
      </SentencePanel>
    );
  }
  return <Invitation run={run} onOpen={open} />;
}

function Invitation({ run, onOpen }: { run: RunDetail; onOpen: () => void }) {
  if (!run.has_policy) {
    return (
      <SentencePanel title="There is no policy to watch yet">
        The first is saved after the first test of the training.
      </SentencePanel>
    );
  }
  return (
    <SentencePanel
      title={run.phase === 'locomotion' ? 'See how the object moves itself' : 'See what the robot does'}
      actions={
        <Button size="md" onClick={onOpen} leftSection={<Icon name="cube" />}>
          Watch the newest policy
        </Button>
      }
    >
      The newest policy acts live in the simulated scene, toward random goals.
    </SentencePanel>
  );
}
