/** The demonstrations of a locomotion run: asked for, waited for, looked at. */
import { Button } from '@mantine/core';
import type { RunDetail } from '@/client/schema.gen';
import { Icon } from '@/components/icon';
import { SentencePanel } from '@/components/sentence-panel';
import { useViewerSession } from '../api/viewer-session';
import { SessionPanels, type SessionWords } from '../components/session-panels';
import { InspectorView } from './inspector-view';

const WORDS: SessionWords = {
  view: 'The view of demonstrations',
  starting: 'The model is being loaded into its scene; this takes a second or two.',
  missing: 'There is no locomotion model yet',
};

export function DemonstrationsTab({ run }: { run: RunDetail }) {
  const viewing = useViewerSession();
  const look = (): void => viewing.open({ kind: 'inspector', run_id: run.id });
  const invitation = (
    <SentencePanel
      title="See what the object makes itself do"
      actions={
        <Button size="md" onClick={look} leftSection={<Icon name="cube" />}>
          Inspect the demonstrations
        </Button>
      }
    >
      Play single demonstrations or hundreds at once, see where they succeed and where not, and what its critic thinks.
    </SentencePanel>
  );
  return (
    <SessionPanels viewing={viewing} words={WORDS} hasPolicy={run.has_policy} onAgain={look} choice={invitation}>
      {(url, message) => <InspectorView url={url} message={message} onClose={viewing.close} />}
    </SessionPanels>
  );
}
