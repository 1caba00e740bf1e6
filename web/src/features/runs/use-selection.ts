/** Which runs are selected: one by one, from the last line to this one with Shift, or all. */
import { useCallback, useRef, useState } from 'react';
import type { RunSummary } from '@/client/schema.gen';
import type { Range, SomeRuns } from './lines';

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

/**
 * @param runsBetween the runs between two lines, both included
 * @param onProblem called when runs cannot be fetched
 */
export function useSelection(runsBetween: (range: Range) => SomeRuns, onProblem: (error: unknown) => void): Selection {
  const [chosen, setChosen] = useState<ReadonlyMap<string, RunSummary>>(new Map());
  const anchor = useRef<number | null>(null);
  const set = (runs: SomeRuns, isSelected: boolean): void => {
    if (runs instanceof Promise) runs.then((found) => setNow(found, isSelected)).catch(onProblem);
    else setNow(runs, isSelected);
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
  }, []);
  return {
    runs: [...chosen.values()],
    has: (id) => chosen.has(id),
    set,
    setLine: (index, isSelected, isRange) => {
      const since = isRange && anchor.current !== null ? anchor.current : index;
      anchor.current = index;
      set(runsBetween({ first: Math.min(since, index), last: Math.max(since, index) }), isSelected);
    },
    clear,
  };
}
