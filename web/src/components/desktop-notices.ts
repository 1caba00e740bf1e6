/** Notifications of the browser: asked for by the person, shown once for each thing that has happened. */
import { useLocalStorage } from '@mantine/hooks';
import { useQuery } from '@tanstack/react-query';
import { useEffect, useRef } from 'react';
import type { Notice } from '@/client/schema.gen';
import { client, unwrap } from '@/lib/api';
import { noticeKey, untold } from '@/lib/notices';

/** How often it is asked what has happened [ms]. */
const POLL_MS = 15_000;
/** How far back the first question looks, when it is not known yet how the server's clock stands [ms]. */
const FIRST_LOOK_MS = 86_400_000;
/** A thing may be written down a little after it has happened, so each question looks back a little [ms]. */
const OVERLAP_MS = 60_000;
const WANTED_KEY = 'sldr-desktop-notices';

/** Whether this browser can show notifications at all. */
export function canNotify(): boolean {
  return typeof Notification !== 'undefined' && window.isSecureContext !== false;
}

/** Whether the person wants them in this browser. */
export function useNoticesWanted(): [boolean, (wanted: boolean) => void] {
  const [isWanted, want] = useLocalStorage({
    key: WANTED_KEY,
    defaultValue: false,
    getInitialValueInEffect: false,
  });
  return [isWanted, want];
}

/** Show what happens from the moment on at which the person wants it; `open` leads to what it is about. */
export function useDesktopNotices(open: (path: string) => void): void {
  const [isWanted] = useNoticesWanted();
  const watch = useRef(beginWatch());
  const told = useRef(new Set<string>());
  const opening = useRef(open);
  opening.current = open;
  const isOn = isWanted && canNotify() && Notification.permission === 'granted';
  // Before the question, whose own effect asks at once.
  useEffect(() => {
    if (isOn) watch.current = beginWatch();
  }, [isOn]);
  const { data } = useQuery({
    queryKey: ['notices'],
    queryFn: ({ signal }) =>
      unwrap(client.GET('/api/notices', { params: { query: { since: watch.current.since } }, signal })),
    enabled: isOn,
    refetchInterval: POLL_MS,
    refetchIntervalInBackground: true,
  });
  useEffect(() => {
    if (data === undefined) return;
    const now = Date.parse(data.now);
    const { wanted, begun = now - (Date.now() - wanted) } = watch.current;
    const since = new Date(Math.max(begun, now - OVERLAP_MS)).toISOString();
    watch.current = { wanted, begun, since };
    const notices = data.notices.filter(({ at }) => Date.parse(at) > begun);
    for (const notice of untold(notices, told.current)) {
      const shown = show(notice);
      if (shown === null) continue;
      shown.onclick = () => {
        window.focus();
        opening.current(notice.path);
      };
    }
  }, [data]);
}

/** Show one; some browsers have notifications and let no page make them, which only trying tells. */
function show(notice: Notice): Notification | null {
  try {
    return new Notification('SLDR', { body: notice.message, tag: noticeKey(notice) });
  } catch (error) {
    if (error instanceof TypeError) return null;
    throw error;
  }
}

/** From which moment on what happens is shown. */
interface Watch {
  /** By this machine's clock, which may be fast or slow [ms]. */
  readonly wanted: number;
  /** By the server's clock, once it has answered [ms]. */
  readonly begun?: number;
  /** What the next question looks back to. */
  readonly since: string;
}

function beginWatch(): Watch {
  const wanted = Date.now();
  return { wanted, since: new Date(wanted - FIRST_LOOK_MS).toISOString() };
}
