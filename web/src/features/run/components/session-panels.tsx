/** What stands where a 3D view is not open yet: that it was refused, failed, ended, starts, or what can be opened. */
import { Button, Loader } from '@mantine/core';
import type { ReactNode } from 'react';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import type { useViewerSession } from '../api/viewer-session';

/** What the panels of one kind of view say. */
export interface SessionWords {
  /** What is opened, as a sentence begins with it: "The 3D view". */
  readonly view: string;
  /** What happens while it starts. */
  readonly starting: string;
  /** That the run has left nothing to show yet. */
  readonly missing: string;
}

interface Props {
  viewing: ReturnType<typeof useViewerSession>;
  words: SessionWords;
  hasPolicy: boolean;
  onAgain: () => void;
  /** Draws the view that is open. */
  children: (url: string, message: string) => ReactNode;
  /** What can be opened. */
  choice: ReactNode;
}

export function SessionPanels({ viewing, words, hasPolicy, onAgain, children, choice }: Props) {
  const { session, isOpening, error, close } = viewing;
  const again = (
    <>
      <Button onClick={onAgain}>Try again</Button>
      <Button variant="default" onClick={close}>
        Back
      </Button>
    </>
  );
  if (error) {
    return (
      <SentencePanel urgent title={`${words.view} cannot be shown`} actions={again}>
        {sentence(error)}
      </SentencePanel>
    );
  }
  if (session?.state === 'failed' || session?.state === 'ended') {
    const hasFailed = session.state === 'failed';
    return (
      <SentencePanel urgent={hasFailed} title={`${words.view} has ${hasFailed ? 'failed' : 'ended'}`} actions={again}>
        {session.message}
      </SentencePanel>
    );
  }
  if (session?.state === 'ready' && session.url !== null) return children(session.url, session.message ?? '');
  if (session || isOpening) {
    return (
      <SentencePanel title={`${words.view} is starting`}>
        <Loader size="sm" mt="sm" mx="auto" display="block" aria-hidden />
        <p role="status">{words.starting}</p>
      </SentencePanel>
    );
  }
  if (!hasPolicy) {
    return (
      <SentencePanel title={words.missing}>The first is saved after the first test of the training.</SentencePanel>
    );
  }
  return choice;
}
