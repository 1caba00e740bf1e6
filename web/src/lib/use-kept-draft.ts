/** The draft of a form, kept for this tab while one looks at another page. */
import { type Dispatch, type SetStateAction, useEffect, useState } from 'react';

interface Place<Draft> {
  /** Which form it is of; each keeps its newest draft alone. */
  readonly form: string;
  /** What the form began with: a draft that began with something else stays where it is. */
  readonly beginning: string;
  /** Whether what was kept is a draft: it may come from another version of the page. */
  readonly isDraft: (kept: unknown) => kept is Draft;
}

interface KeptDraft<Draft> {
  readonly draft: Draft;
  readonly setDraft: Dispatch<SetStateAction<Draft>>;
  /** It has served: the form begins anew next time. */
  readonly forget: () => void;
}

/** @param begin the draft of a form that nobody has touched */
export function useKeptDraft<Draft>(begin: Draft, { form, beginning, isDraft }: Place<Draft>): KeptDraft<Draft> {
  const key = `sldr-draft-${form}`;
  const [untouched] = useState(() => JSON.stringify(begin));
  const [draft, setDraft] = useState(() => {
    const kept = read(key, beginning);
    return isDraft(kept) ? kept : begin;
  });
  const text = JSON.stringify(draft);
  useEffect(() => {
    if (text !== untouched) write(key, JSON.stringify({ beginning, draft: JSON.parse(text) }));
    else if (read(key, beginning) !== undefined) write(key, null);
  }, [key, beginning, text, untouched]);
  return { draft, setDraft, forget: () => write(key, null) };
}

/** What is kept of this beginning, if anything. */
function read(key: string, beginning: string): unknown {
  try {
    const kept: unknown = JSON.parse(window.sessionStorage.getItem(key) ?? 'null');
    const { beginning: its, draft } = Object(kept) as { beginning?: unknown; draft?: unknown };
    return its === beginning ? draft : undefined;
  } catch {
    // It is broken, or this browser keeps nothing: the form begins anew.
    return undefined;
  }
}

function write(key: string, text: string | null): void {
  try {
    if (text === null) window.sessionStorage.removeItem(key);
    else window.sessionStorage.setItem(key, text);
  } catch {
    // A browser that keeps nothing loses the draft with the page.
  }
}
