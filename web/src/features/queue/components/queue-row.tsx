/** One run of the queue: its place, what it waits for, when it starts and ends, and the ways to move it. */
import { ActionIcon } from '@mantine/core';
import { type DragEvent, type KeyboardEvent, useRef, useState } from 'react';
import type { QueueEntry } from '@/client/schema.gen';
import { AnchorLink } from '@/components/anchor-link';
import { Icon } from '@/components/icon';
import { OnlyFor } from '@/components/only-for';
import { PriorityField } from '@/components/priority-field';
import { Reason } from '@/components/reason';
import { RunRemedy } from '@/components/run-remedy';
import { StateBadge } from '@/components/state-badge';
import { useComplaint } from '@/components/toasts';
import { runTitle } from '@/lib/run-title';
import { wishOf } from '@/lib/states';
import { useSetPriority } from '@/lib/use-run-actions';
import type { Move } from '../order';
import { Expected } from './expected';
import classes from './queue.module.css';

interface Props {
  entry: QueueEntry;
  isMovable: boolean;
  isDragged: boolean;
  /** Whether the dragged run may be dropped here. */
  isTarget: boolean;
  onDrag: (isDragging: boolean) => void;
  onDrop: (isLower: boolean) => void;
  up: Move | undefined;
  down: Move | undefined;
  onMove: (move: Move | undefined) => void;
}

export function QueueRow({ entry, isMovable, isDragged, isTarget, onDrag, onDrop, up, down, onMove }: Props) {
  const { run, position, waits_for } = entry;
  const row = useRef<HTMLLIElement>(null);
  const [edge, setEdge] = useState<'upper' | 'lower' | null>(null);
  const press = (event: KeyboardEvent): void => {
    if (!event.altKey || (event.key !== 'ArrowUp' && event.key !== 'ArrowDown')) return;
    event.preventDefault();
    // The field of the priority would step too.
    event.stopPropagation();
    onMove(event.key === 'ArrowUp' ? up : down);
  };
  const over = (event: DragEvent<HTMLLIElement>): void => {
    if (!isTarget) return;
    event.preventDefault();
    const { top, height } = event.currentTarget.getBoundingClientRect();
    setEdge(event.clientY > top + height / 2 ? 'lower' : 'upper');
  };
  return (
    <li
      ref={row}
      className={classes.row}
      data-run={run.id}
      data-dragged={isDragged || undefined}
      data-edge={edge ?? undefined}
      onKeyDownCapture={press}
      onDragOver={over}
      onDragLeave={() => setEdge(null)}
      onDrop={(event) => {
        event.preventDefault();
        onDrop(edge === 'lower');
        setEdge(null);
      }}
    >
      <span className={classes.place}>
        {isMovable && (
          // biome-ignore lint/a11y/noStaticElementInteractions: for the mouse; the buttons do the same
          <span
            className={classes.grip}
            draggable
            title="Drag to another place"
            onDragStart={(event) => {
              event.dataTransfer.effectAllowed = 'move';
              event.dataTransfer.setData('text/plain', run.id);
              if (row.current) event.dataTransfer.setDragImage(row.current, 12, 12);
              onDrag(true);
            }}
            onDragEnd={() => onDrag(false)}
          >
            <Icon name="grip" size={15} />
          </span>
        )}
        <b className="number">{position ?? ''}</b>
      </span>
      <div className={classes.what}>
        <span className={classes.title}>
          <AnchorLink to="/runs/$runId" params={{ runId: run.id }} fw={600} fz="inherit" aria-label={runTitle(run)}>
            {run.task}
          </AnchorLink>
          <StateBadge state={run.state} wish={wishOf(run)} />
        </span>
        <span className="faint">
          {run.phase} · {run.method} · seed {run.seed} · {run.preset}
        </span>
      </div>
      <div className={classes.why}>
        <Reason text={waits_for} runIds={run.needs} />
        <RunRemedy run={run} />
      </div>
      <Expected entry={entry} />
      <Priority entry={entry} />
      <span className={classes.moves}>
        {isMovable && (
          <>
            <MoveButton label={`Move ${runTitle(run)} up`} icon="up" move={up} onMove={onMove} />
            <MoveButton label={`Move ${runTitle(run)} down`} icon="down" move={down} onMove={onMove} />
          </>
        )}
      </span>
    </li>
  );
}

interface MoveProps {
  label: string;
  icon: 'up' | 'down';
  move: Move | undefined;
  onMove: (move: Move | undefined) => void;
}

function MoveButton({ label, icon, move, onMove }: MoveProps) {
  return (
    // Not `disabled`: that would take the focus away at the ends of the list.
    <ActionIcon
      variant="subtle"
      color="gray"
      aria-label={label}
      aria-disabled={move === undefined}
      className={classes.move}
      onClick={() => onMove(move)}
    >
      <Icon name={icon} size={15} />
    </ActionIcon>
  );
}

function Priority({ entry: { run } }: { entry: QueueEntry }) {
  const complain = useComplaint();
  const setting = useSetPriority();
  return (
    <span className={classes.priority}>
      <span className="faint">Priority</span>
      <OnlyFor least="operator" otherwise={<span className="number">{run.priority}</span>}>
        <PriorityField
          value={run.priority}
          label={`Priority of ${runTitle(run)}`}
          onSet={(priority) => setting.mutateAsync({ runIds: [run.id], priority }, { onError: complain })}
        />
      </OnlyFor>
    </span>
  );
}
