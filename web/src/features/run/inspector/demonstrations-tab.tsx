/** The demonstrations of a locomotion run: asked for, waited for, looked at. */
import { Button, Loader } from '@mantine/core';
import type { RunDetail } from '@/client/schema.gen';
import { Icon } from '@/components/icon';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { useViewerSession } from '../api/viewer-session';
import { InspectorView } from './inspector-view';

export function DemonstrationsTab({ run }: { run: RunDetail }) {
  const { session, isOpening, error, open, close } = useViewerSession();
  const look = (): void => open({ kind: 'inspector', run_id: run.id });
  const again = <Button onClick={look}>Try again</Button>;
  if (error) {
    return (
      <SentencePanel urgent title="The demonstrations cannot be shown" actions={again}>
        {sentence(error)}
      </SentencePanel>
    );
  }
  if (session?.state === 'failed' || session?.state === 'ended') {
    return (
      <SentencePanel urgent={session.state === 'failed'} title="The view of demonstrations has ended" actions={again}>
        {session.message}
      </SentencePanel>
    );
  }
  if (session?.state === 'ready' && session.url !== null) {
    return <InspectorView url={session.url} message={session.message ?? ''} onClose={close} />;
  }
  if (session || isOpening) {
    return (
      <SentencePanel title="The demonstrations are being prepared">
        <Loader size="sm" mt="sm" mx="auto" display="block" aria-hidden />
        <p role="status">The model is being loaded into its scene; this takes a second or two.</p>
      </SentencePanel>
    );
  }
  if (!run.has_policy) {
    return (
      <SentencePanel title="There is no locomotion model yet">
        The first is saved after the first test of the training.
      </SentencePanel>
    );
  }
  return (
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
}
