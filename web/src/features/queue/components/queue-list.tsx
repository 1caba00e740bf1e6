/** The queue as a list whose waiting runs can be put in another order: by mouse, by button, or with Alt and the arrows. */
import { useLayoutEffect, useRef, useState } from 'react';
import type { QueueEntry } from '@/client/schema.gen';
import { useComplaint } from '@/components/toasts';
import { useMay } from '@/lib/access';
import { runTitle } from '@/lib/run-title';
import { useMoveRun } from '../api/move-run';
import { dropped, isMovable, type Move, type ShownQueue, stepped } from '../order';
import classes from './queue.module.css';
import { QueueRow } from './queue-row';

export function QueueList({ queue }: { queue: ShownQueue }) {
  const { entries } = queue;
  const complain = useComplaint();
  const moving = useMoveRun();
  const isMine = useMay('operator');
  const [dragged, setDragged] = useState<string | null>(null);
  const [news, setNews] = useState('');
  const focused = useKeptFocus(entries.map((entry) => entry.run.id).join());

  const move = (wish: Move | undefined): void => {
    if (wish === undefined) return;
    focused.current = document.activeElement;
    moving.mutate(wish, {
      onError: (error) => {
        complain(error);
        setNews('The order is as it was.');
      },
    });
    setNews(sentenceOf(entries, wish));
  };
  return (
    <>
      <p className={`faint ${classes.help}`}>
        {isMine && 'Drag a queued run to another place, use its arrows, or press Alt with the up and down keys. '}
        Runs of a higher priority start first.
      </p>
      <ol className={`card ${classes.list}`} aria-label="Queue">
        {entries.map((entry) => {
          const { id } = entry.run;
          return (
            <QueueRow
              key={id}
              entry={entry}
              isMovable={isMine && isMovable(entry)}
              isDragged={dragged === id}
              isTarget={dragged !== null && dragged !== id && isMovable(entry)}
              onDrag={(isDragging) => setDragged(isDragging ? id : null)}
              onDrop={(isLower) => {
                if (dragged !== null) move(dropped(queue, dragged, id, isLower));
                setDragged(null);
              }}
              up={isMine ? stepped(queue, id, -1) : undefined}
              down={isMine ? stepped(queue, id, 1) : undefined}
              onMove={move}
            />
          );
        })}
      </ol>
      <output className="hidden">{news}</output>
    </>
  );
}

function sentenceOf(entries: readonly QueueEntry[], { runId, before }: Move): string {
  const title = (id: string): string => {
    const found = entries.find((entry) => entry.run.id === id);
    return found ? runTitle(found.run) : id;
  };
  return before === null ? `${title(runId)} is now the last.` : `${title(runId)} now stands before ${title(before)}.`;
}

/** Rows that change places lose the focus; give it back to what had it when the order was changed. */
function useKeptFocus(order: string) {
  const focused = useRef<Element | null>(null);
  // biome-ignore lint/correctness/useExhaustiveDependencies: only a new order can have taken the focus
  useLayoutEffect(() => {
    if (document.activeElement === document.body && focused.current instanceof HTMLElement) focused.current.focus();
    focused.current = null;
  }, [order]);
  return focused;
}
