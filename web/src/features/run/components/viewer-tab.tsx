/** Look at a run in 3D: choose what to show, wait for it, and drive it. */
import { Button, Loader } from '@mantine/core';
import { useEffect, useRef } from 'react';
import type { RunDetail } from '@/client/schema.gen';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { useViewerSession } from '../api/viewer-session';
import { readEpisode } from '../episodes/place';
import { FIRST_CHOICE, type SceneChoice, sceneRequest } from '../scene-choice';
import { SceneChoiceForm } from './scene-choice-form';
import { SceneView } from './scene-view';

export function ViewerTab({ run, episode }: { run: RunDetail; episode: string | undefined }) {
  const { session, isOpening, error, open, close } = useViewerSession();
  const asked = readEpisode(episode);
  const choice = useRef<SceneChoice>({ ...FIRST_CHOICE, ...(asked && { kind: 'episode', ...asked }) });
  const watch = (chosen: SceneChoice): void => {
    choice.current = chosen;
    open(sceneRequest(run.id, chosen));
  };
  // biome-ignore lint/correctness/useExhaustiveDependencies: an address that names an episode opens it, once
  useEffect(() => {
    if (asked !== undefined) watch(choice.current);
  }, []);
  const again = (
    <>
      <Button onClick={() => watch(choice.current)}>Try again</Button>
      <Button variant="default" onClick={close}>
        Choose something else
      </Button>
    </>
  );
  if (error) {
    return (
      <SentencePanel urgent title="The 3D view cannot be shown" actions={again}>
        {sentence(error)}
      </SentencePanel>
    );
  }
  if (session?.state === 'failed' || session?.state === 'ended') {
    const hasFailed = session.state === 'failed';
    return (
      <SentencePanel
        urgent={hasFailed}
        title={hasFailed ? 'The 3D view failed' : 'The 3D view has ended'}
        actions={again}
      >
        {session.message}
      </SentencePanel>
    );
  }
  if (session?.state === 'ready' && session.url !== null) {
    const { kind, epoch, index } = choice.current;
    const recorded = kind === 'episode' ? { runId: run.id, epoch, number: index } : undefined;
    return <SceneView url={session.url} message={session.message ?? ''} recorded={recorded} onClose={close} />;
  }
  if (session || isOpening) {
    return (
      <SentencePanel title="The 3D view is starting">
        <Loader size="sm" mt="sm" mx="auto" display="block" aria-hidden />
        <p role="status">The scene is being built; this takes a second or two.</p>
      </SentencePanel>
    );
  }
  if (!run.has_policy) {
    return (
      <SentencePanel title="There is no policy to watch yet">
        The first is saved after the first test of the training.
      </SentencePanel>
    );
  }
  return <SceneChoiceForm run={run} first={choice.current} onWatch={watch} />;
}
