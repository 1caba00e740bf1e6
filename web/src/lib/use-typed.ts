/** A text that stands in the address and is typed here: what is typed shows at once, and the caret stays. */
import { useEffect, useRef, useState } from 'react';

export interface Typed {
  readonly typed: string;
  /** Show it, without a change of the address. */
  readonly type: (text: string) => void;
  /** Bring it into the address. */
  readonly send: (text: string) => void;
}

/** @param text what the address says */
export function useTyped(text: string, onSend: (text: string) => void): Typed {
  const [typed, setTyped] = useState(text);
  // What was typed is on its way into the address; anything else that comes to stand there came from outside.
  const sent = useRef<readonly string[]>([]);
  useEffect(() => {
    const isOwn = sent.current.includes(text);
    if (!isOwn || text === sent.current.at(-1)) sent.current = [];
    if (!isOwn) setTyped(text);
  }, [text]);
  const send = (next: string): void => {
    sent.current = [...sent.current, next];
    onSend(next);
  };
  return { typed, type: setTyped, send };
}
