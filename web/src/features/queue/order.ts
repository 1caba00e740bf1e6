/** The order of the queue, and what moving a run in it means. */
import type { QueueEntry } from '@/client/schema.gen';

/** A wish to put a run before another one, or at the end. */
export interface Move {
  readonly runId: string;
  readonly before: string | null;
}

/** Whether a run has a place that can change; blocked and paused ones get theirs when they are queued. */
export function isMovable({ run }: QueueEntry): boolean {
  return run.state === 'queued';
}

/** What is known of the queue: the rows shown, and whether they are all. */
export interface ShownQueue {
  readonly entries: readonly QueueEntry[];
  readonly isWhole: boolean;
}

/** One place up or down; undefined where the run stands at that end already, or nobody knows what follows. */
export function stepped({ entries, isWhole }: ShownQueue, runId: string, step: -1 | 1): Move | undefined {
  const ids = entries.filter(isMovable).map((entry) => entry.run.id);
  const at = ids.indexOf(runId);
  if (at === -1 || ids[at + step] === undefined) return undefined;
  return placedBefore(runId, step === -1 ? ids[at - 1] : ids[at + 2], isWhole);
}

/** Dropped on the upper or lower half of another row; undefined where that changes nothing, or nobody knows what follows. */
export function dropped(
  { entries, isWhole }: ShownQueue,
  runId: string,
  on: string,
  isLower: boolean,
): Move | undefined {
  const ids = entries.filter(isMovable).map((entry) => entry.run.id);
  const place = ids.indexOf(on) + (isLower ? 1 : 0);
  const at = ids.indexOf(runId);
  if (at === -1 || ids.indexOf(on) === -1 || place === at || place === at + 1) return undefined;
  return placedBefore(runId, ids[place], isWhole);
}

/** Behind the last row shown is the end of the queue only if no more rows follow. */
function placedBefore(runId: string, before: string | undefined, isWhole: boolean): Move | undefined {
  return before === undefined && !isWhole ? undefined : { runId, before: before ?? null };
}

/** The queue as it will be; places are counted anew by the server. */
export function reordered(entries: readonly QueueEntry[], { runId, before }: Move): QueueEntry[] {
  const moved = entries.find((entry) => entry.run.id === runId);
  const others = entries.filter((entry) => entry.run.id !== runId);
  // The end is that of the queued runs: what is blocked or paused stands by itself.
  const at = before === null ? others.findLastIndex(isMovable) + 1 : others.findIndex(({ run }) => run.id === before);
  if (moved === undefined || at === -1) return [...entries];
  return [...others.slice(0, at), moved, ...others.slice(at)];
}

/** When the last of them is expected to have ended [ms]; null if nobody can say of some. */
export function endOf(entries: readonly QueueEntry[]): number | null {
  const ends = entries.filter(({ run }) => run.state !== 'paused').map((entry) => entry.ends_at);
  if (ends.length === 0 || ends.includes(null)) return null;
  return Math.max(...ends.map((end) => Date.parse(end ?? '')));
}
