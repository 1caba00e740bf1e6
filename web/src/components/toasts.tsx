/** Short notices in a corner: what was done, with a way back where there is one. */
import { Button, CloseButton } from '@mantine/core';
import { createContext, type ReactNode, useCallback, useContext, useEffect, useRef, useState } from 'react';
import { sentence } from '@/lib/api';
import classes from './toasts.module.css';

export interface Notice {
  readonly text: string;
  /** Further sentences, such as what was not done and why. */
  readonly details?: readonly string[];
  /** Whether something went wrong. */
  readonly isProblem?: boolean;
  /** How to take it back. */
  readonly undo?: () => void;
}

/** How long a notice stays while nobody points at it [ms]. */
const SHOWN_MS = 10_000;

/** Older notices make room for newer ones. */
const MOST_NOTICES = 4;

const Show = createContext<(notice: Notice) => void>(() => {});

/** Show a notice. */
export function useToast(): (notice: Notice) => void {
  return useContext(Show);
}

/** Say why something was not done. */
export function useComplaint(): (error: unknown) => void {
  const show = useToast();
  return useCallback((error: unknown) => show({ text: sentence(error), isProblem: true }), [show]);
}

/** What is inside may show notices, and they outlive the page that did. */
export function Toasts({ children }: { children: ReactNode }) {
  const [notices, setNotices] = useState<readonly (Notice & { id: number })[]>([]);
  const shown = useRef(0);
  const show = useCallback((notice: Notice) => {
    shown.current += 1;
    const added = { ...notice, id: shown.current };
    setNotices((others) => [...others, added].slice(-MOST_NOTICES));
  }, []);
  const hide = useCallback((id: number) => setNotices((all) => all.filter((notice) => notice.id !== id)), []);
  return (
    <Show value={show}>
      {children}
      <section className={classes.corner} aria-label="Notices" aria-live="polite">
        {notices.map((notice) => (
          <Toast key={notice.id} notice={notice} onHide={() => hide(notice.id)} />
        ))}
      </section>
    </Show>
  );
}

function Toast({ notice, onHide }: { notice: Notice; onHide: () => void }) {
  const [isHeld, setHeld] = useState(false);
  const hide = useRef(onHide);
  hide.current = onHide;
  useEffect(() => {
    if (isHeld) return;
    const timer = setTimeout(() => hide.current(), SHOWN_MS);
    return () => clearTimeout(timer);
  }, [isHeld]);
  const { text, details = [], isProblem, undo } = notice;
  return (
    // biome-ignore lint/a11y/noStaticElementInteractions: pointing at a notice only keeps it from leaving
    <div
      className={classes.toast}
      data-problem={isProblem || undefined}
      role={isProblem ? 'alert' : undefined}
      onMouseEnter={() => setHeld(true)}
      onMouseLeave={() => setHeld(false)}
      onFocus={() => setHeld(true)}
      onBlur={() => setHeld(false)}
    >
      <div className={classes.text}>
        <b>{text}</b>
        {details.map((detail) => (
          <span key={detail}>{detail}</span>
        ))}
      </div>
      {undo && (
        <Button
          variant="light"
          size="compact-sm"
          onClick={() => {
            undo();
            onHide();
          }}
        >
          Undo
        </Button>
      )}
      <CloseButton size="sm" aria-label="Close this notice" onClick={onHide} />
    </div>
  );
}
