/** The time, as state. */
import { useEffect, useState } from 'react';
import { serverNow } from '@/lib/server-clock';

/** The server's time in ms, renewed every `everyMs`: for moments that the server has told. */
export function useNow(everyMs = 1000): number {
  return useTicking(serverNow, everyMs);
}

/** The browser's own time in ms: for moments that the browser has noted, such as when an answer came. */
export function useBrowserNow(everyMs = 1000): number {
  return useTicking(Date.now, everyMs);
}

/** @param read one function for all of its life */
function useTicking(read: () => number, everyMs: number): number {
  const [now, setNow] = useState(read);
  useEffect(() => {
    const timer = setInterval(() => setNow(read()), everyMs);
    return () => clearInterval(timer);
  }, [read, everyMs]);
  return now;
}
