/** Which runs are selected: one by one, from the last line to this one with Shift, or all. */
import { useCallback, useRef, useState } from 'react';
import type { RunSummary } from '@/client/schema.gen';
import type { Lines, SomeRuns } from './lines';

export interface Selection {
  /** The selected runs as they were when they were selected. */
  readonly runs: readonly RunSummary[];
  has: (id: string) => boolean;
  /** Select runs or leave them out; at once if they are at hand. */
  set: (runs: SomeRuns, isSelected: boolean) => void;
  /** Select a line or leave it out; with `isRange`, all lines since the one before too. */
  setLine: (index: number, isSelected: boolean, isRange: boolean) => void;
  clear: () => void;
}

/** Where a range begins: a run, for lines move while they are looked at, and the line where it stood. */
interface Anchor {
  readonly id: string | null;
  readonly index: number;
}

/**
 * @param lines the lines as they stand now
 * @param onProblem called when runs cannot be fetched
 */
export function useSelection(
  lines: Pick<Lines, 'lineAt' | 'indexOf' | 'runsBetween'>,
  onProblem: (error: unknown) => void,
): Selection {
  const [chosen, setChosen] = useState<ReadonlyMap<string, RunSummary>>(new Map());
  const anchor = useRef<Anchor | null>(null);
  const clearings = useRef(0);
  const set = (runs: SomeRuns, isSelected: boolean): void => {
    if (!(runs instanceof Promise)) {
      setNow(runs, isSelected);
      return;
    }
    const before = clearings.current;
    // Runs that were asked for before clearing may be hidden by now.
    const isWanted = (): boolean => clearings.current === before;
    runs.then(
      (found) => isWanted() && setNow(found, isSelected),
      (error) => isWanted() && onProblem(error),
    );
  };
  const setNow = (runs: readonly RunSummary[], isSelected: boolean): void =>
    setChosen((before) => {
      const after = new Map(before);
      for (const run of runs) {
        if (isSelected) after.set(run.id, run);
        else after.delete(run.id);
      }
      return after;
    });
  const clear = useCallback(() => {
    setChosen((before) => (before.size === 0 ? before : new Map()));
    anchor.current = null;
    clearings.current += 1;
  }, []);
  return {
    runs: [...chosen.values()],
    has: (id) => chosen.has(id),
    set,
    setLine: (index, isSelected, isRange) => {
      const since = isRange && anchor.current !== null ? placeOf(anchor.current, lines) : index;
      const line = lines.lineAt(index);
      anchor.current = { id: line.kind === 'run' ? line.run.id : null, index };
      set(lines.runsBetween({ first: Math.min(since, index), last: Math.max(since, index) }), isSelected);
    },
    clear,
  };
}

function placeOf(anchor: Anchor, lines: Pick<Lines, 'indexOf'>): number {
  const index = anchor.id === null ? -1 : lines.indexOf(anchor.id);
  return index === -1 ? anchor.index : index;
}
