/** A window that only grows while one looks at it. */
import { useRef } from 'react';
import { hull } from '@/lib/curves';
import type { Range } from '@/lib/zoom';

/**
 * The window that holds what is there now and all that was there before.
 * @param view what is looked at; another view starts afresh
 */
export function useGrowing(range: Range | null, view: string): Range | null {
  const held = useRef<{ readonly view: string; readonly range: Range | null }>({ view, range: null });
  const known = held.current.view === view ? held.current.range : null;
  const grown = hull(known, range);
  const isSame = known !== null && grown !== null && known[0] === grown[0] && known[1] === grown[1];
  held.current = { view, range: isSame ? known : grown };
  return held.current.range;
}
