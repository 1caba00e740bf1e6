/** Rerun's viewer in an element of the page: fetched when it is first needed, given back when the element goes. */
import type { WebViewer } from '@rerun-io/web-viewer';
import { type RefObject, useEffect, useRef, useState } from 'react';

/** Where the viewer stands: it comes (14 MB), it opens the recording, it shows it. */
export type ViewerState = 'loading' | 'opening' | 'shown';

/** What the recording may be played along. */
export const TIMELINES = { env_steps: 'Training', episode_step: 'Steps of an episode' } as const;
export type Timeline = keyof typeof TIMELINES;

export interface RerunViewer {
  readonly state: ViewerState;
  /** Why it cannot be shown. */
  readonly problem: string | undefined;
  readonly setTimeline: (timeline: Timeline) => void;
}

/**
 * @param url the recording; when it changes, the new one is opened and the old one closed
 * @param ticket what opens it: the viewer sends no cookie
 */
export function useRerunViewer(
  parent: RefObject<HTMLElement | null>,
  url: string,
  ticket: string,
  theme: 'dark' | 'light',
): RerunViewer {
  const [state, setState] = useState<ViewerState>('loading');
  const [problem, setProblem] = useState<string>();
  const held = useRef<WebViewer>(null);
  const shown = useRef<{ url: string; address: string }>(null);
  const address = `${url}&ticket=${encodeURIComponent(ticket)}`;
  const wanted = useRef({ url, address });
  wanted.current = { url, address };

  useEffect(() => {
    let isGone = false;
    let viewer: WebViewer | undefined;
    const start = async (): Promise<void> => {
      const { WebViewer } = await import('@rerun-io/web-viewer');
      if (isGone) return;
      viewer = new WebViewer();
      viewer.on('recording_open', () => setState('shown'));
      setState('opening');
      shown.current = wanted.current;
      await viewer.start(shown.current.address, parent.current, OPTIONS(theme), { follow_if_http: false });
      if (isGone) viewer.stop();
      else held.current = viewer;
    };
    start().catch((error: unknown) => setProblem(error instanceof Error ? error.message : String(error)));
    return () => {
      isGone = true;
      held.current = null;
      viewer?.stop();
    };
  }, [parent, theme]);

  useEffect(() => {
    const viewer = held.current;
    if (viewer === null || shown.current?.url === url) return;
    viewer.open(wanted.current.address, { follow_if_http: false });
    if (shown.current !== null) viewer.close(shown.current.address);
    shown.current = { ...wanted.current };
  }, [url]);

  const setTimeline = (timeline: Timeline): void => {
    const recording = held.current?.get_active_recording_id();
    if (recording) held.current?.set_active_timeline(recording, timeline);
  };
  return { state, problem, setTimeline };
}

const OPTIONS = (theme: 'dark' | 'light') => ({
  hide_welcome_screen: true,
  width: '100%',
  height: '100%',
  theme,
});
