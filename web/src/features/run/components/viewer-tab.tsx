/** Look at a run in 3D: choose what to show, wait for it, and drive it. */
import { useEffect, useRef } from 'react';
import type { RunDetail } from '@/client/schema.gen';
import { useViewerSession } from '../api/viewer-session';
import { readEpisode } from '../episodes/place';
import { FIRST_CHOICE, type SceneChoice, sceneRequest } from '../scene-choice';
import { SceneChoiceForm } from './scene-choice-form';
import { SceneView } from './scene-view';
import { SessionPanels, type SessionWords } from './session-panels';

const WORDS: SessionWords = {
  view: 'The 3D view',
  starting: 'The scene is being built; this takes a second or two.',
  missing: 'There is no policy to watch yet',
};

export function ViewerTab({ run, episode }: { run: RunDetail; episode: string | undefined }) {
  const viewing = useViewerSession();
  const asked = readEpisode(episode);
  const choice = useRef<SceneChoice>({ ...FIRST_CHOICE, ...(asked && { kind: 'episode', ...asked }) });
  const watch = (chosen: SceneChoice): void => {
    choice.current = chosen;
    viewing.open(sceneRequest(run.id, chosen));
  };
  // biome-ignore lint/correctness/useExhaustiveDependencies: an address that names an episode opens it, once
  useEffect(() => {
    if (asked !== undefined) watch(choice.current);
  }, []);
  return (
    <SessionPanels
      viewing={viewing}
      words={WORDS}
      hasPolicy={run.has_policy}
      onAgain={() => watch(choice.current)}
      choice={<SceneChoiceForm run={run} first={choice.current} onWatch={watch} />}
    >
      {(url, message) => {
        const { kind, epoch, index } = choice.current;
        const recorded = kind === 'episode' ? { runId: run.id, epoch, number: index } : undefined;
        return <SceneView url={url} message={message} recorded={recorded} onClose={viewing.close} />;
      }}
    </SessionPanels>
  );
}
