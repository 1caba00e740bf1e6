/** Whether a part of the page is on the screen, or nearly. */
import { type RefObject, useEffect, useRef, useState } from 'react';

/** What is this close to the screen is drawn already. */
const NEARLY = '250px';

export function useSeen<E extends Element>(): [RefObject<E | null>, boolean] {
  const part = useRef<E>(null);
  const [isSeen, setSeen] = useState(false);
  useEffect(() => {
    if (part.current === null) return;
    const watch = new IntersectionObserver((changes) => setSeen(changes.at(-1)?.isIntersecting ?? false), {
      rootMargin: NEARLY,
    });
    watch.observe(part.current);
    return () => watch.disconnect();
  }, []);
  return [part, isSeen];
}
