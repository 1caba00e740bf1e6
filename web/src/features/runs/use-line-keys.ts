/** The table by keyboard: arrows go from line to line, with Shift they select on the way, Enter opens, Escape clears. */
import { type KeyboardEvent, useLayoutEffect, useRef, useState } from 'react';

const STEPS: Readonly<Record<string, number>> = {
  ArrowDown: 1,
  ArrowUp: -1,
  PageDown: 15,
  PageUp: -15,
  Home: Number.NEGATIVE_INFINITY,
  End: Number.POSITIVE_INFINITY,
};

interface Doings {
  count: number;
  scrollTo: (index: number) => void;
  /** Select everything from one line to the next. */
  onExtend: (from: number, to: number) => void;
  /** Show a run, or open or close a group; with `isOpen`, only do that. */
  onEnter: (index: number, isOpen?: boolean) => void;
  onClear: () => void;
}

/** The line that the Tab key leads to, and what keys in the table do. */
export interface LineKeys {
  readonly active: number;
  setActive: (index: number) => void;
  onKeyDown: (event: KeyboardEvent<HTMLElement>) => void;
}

export function useLineKeys({ count, scrollTo, onExtend, onEnter, onClear }: Doings): LineKeys {
  const [active, setActive] = useState(0);
  const wanted = useRef<{ place: HTMLElement; index: number } | null>(null);
  // After each render: the line to go to may have to be scrolled to first.
  useLayoutEffect(() => {
    if (wanted.current === null) return;
    const { place, index } = wanted.current;
    const box = boxOf(place, index);
    const isGone = isElsewhere(place);
    if (box !== null || isGone) wanted.current = null;
    if (!isGone) box?.focus({ preventScroll: true });
  });
  const onKeyDown = (event: KeyboardEvent<HTMLElement>): void => {
    const index = lineOf(event.target as HTMLElement);
    if (index === null) return;
    const step = STEPS[event.key];
    if (step !== undefined) {
      event.preventDefault();
      const next = Math.min(count - 1, Math.max(0, index + step));
      if (event.shiftKey) onExtend(index, next);
      wanted.current = { place: event.currentTarget, index: next };
      scrollTo(next);
      setActive(next);
      boxOf(event.currentTarget, next)?.focus({ preventScroll: true });
    } else if (event.key === 'Enter') onEnter(index);
    else if (event.key === 'ArrowRight') onEnter(index, true);
    else if (event.key === 'ArrowLeft') onEnter(index, false);
    else if (event.key === 'Escape') onClear();
  };
  const take = (index: number): void => {
    if (index !== wanted.current?.index) wanted.current = null;
    setActive(index);
  };
  return { active: Math.min(active, Math.max(0, count - 1)), setActive: take, onKeyDown };
}

/** The line whose box has the focus; keys in links and fields are not ours. */
function lineOf(target: HTMLElement): number | null {
  if (target.dataset.lineBox === undefined) return null;
  const index = Number(target.closest<HTMLElement>('[data-line]')?.dataset.line);
  return Number.isInteger(index) ? index : null;
}

/** Whether the focus was taken out of the table; with a line that is drawn no more it is merely lost. */
function isElsewhere(place: HTMLElement): boolean {
  const { activeElement } = document;
  return activeElement !== document.body && !place.contains(activeElement);
}

function boxOf(place: HTMLElement, index: number): HTMLElement | null {
  return place.querySelector<HTMLElement>(`[data-line="${index}"] [data-line-box]`);
}
