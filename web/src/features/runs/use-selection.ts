/** Which rows are selected: one by one, or from the last to this one with Shift. */
import { useRef, useState } from 'react';

export interface Selection {
  /** The selected ids, in the order of the rows. */
  readonly ids: readonly string[];
  has: (id: string) => boolean;
  /** Select or leave out a row; with `isRange`, all rows since the one before too. */
  set: (id: string, isSelected: boolean, isRange: boolean) => void;
  selectAll: (ids: readonly string[]) => void;
  clear: () => void;
}

/** @param rows ids of the rows, in their order; what is no longer among them is not selected either */
export function useSelection(rows: readonly string[]): Selection {
  const [chosen, setChosen] = useState<ReadonlySet<string>>(new Set());
  const anchor = useRef<string | null>(null);
  return {
    ids: rows.filter((id) => chosen.has(id)),
    has: (id) => chosen.has(id),
    set: (id, isSelected, isRange) => {
      const since = isRange && anchor.current !== null ? rows.indexOf(anchor.current) : -1;
      const touched = since === -1 ? [id] : between(rows, since, rows.indexOf(id));
      setChosen(
        isSelected ? new Set([...chosen, ...touched]) : new Set([...chosen].filter((o) => !touched.includes(o))),
      );
      anchor.current = id;
    },
    selectAll: (ids) => setChosen(new Set(ids)),
    clear: () => {
      setChosen(new Set());
      anchor.current = null;
    },
  };
}

function between(rows: readonly string[], one: number, other: number): readonly string[] {
  return rows.slice(Math.min(one, other), Math.max(one, other) + 1);
}
