/** What can be done in the table: sort, select, open groups, narrow it to a tag. */
import { useNavigate } from '@tanstack/react-router';
import { useEffect } from 'react';
import type { RunGroup, RunSummary } from '@/client/schema.gen';
import { useComplaint } from '@/components/toasts';
import { fetchRowsBetween } from './api/list-runs';
import type { Lines, Range } from './lines';
import { filterOf, type RunsSearch } from './search';
import { type Sorting, searchOf, sortingOf } from './sorting';
import { type Selection, useSelection } from './use-selection';

/** As many runs as one request may name. */
export const MOST_SELECTED = 1000;

export interface Table {
  readonly selection: Selection;
  readonly allSelected: 'all' | 'some' | 'none';
  readonly sorting: Sorting;
  sort: (sorting: Sorting) => void;
  selectAll: (isSelected: boolean) => void;
  selectGroup: (group: RunGroup, isSelected: boolean) => void;
  /** How many runs of a group are selected. */
  selectedIn: (group: RunGroup) => number;
  extend: (from: number, to: number) => void;
  enter: (index: number, isOpen?: boolean) => void;
  pickTag: (tag: string) => void;
}

export interface TableProps {
  search: RunsSearch;
  lines: Lines;
  table: Table;
  /** Called with the lines in view. */
  onRange: (range: Range) => void;
}

export function useTable(search: RunsSearch, lines: Lines, onChange: (changes: RunsSearch) => void): Table {
  const navigate = useNavigate();
  const complain = useComplaint();
  const selection = useSelection(lines, complain);
  // Runs that the filters hide must not be acted on by mistake.
  const filter = JSON.stringify(filterOf(search));
  // biome-ignore lint/correctness/useExhaustiveDependencies: it is the change of the filter that clears
  useEffect(() => selection.clear(), [filter, selection.clear]);
  const total = lines.total ?? 0;
  const selected = selection.runs.length;
  return {
    selection,
    allSelected: selected === 0 ? 'none' : selected >= Math.min(total, MOST_SELECTED) ? 'all' : 'some',
    sorting: sortingOf(search),
    sort: (sorting) => onChange(searchOf(sorting)),
    selectAll: (isSelected) => {
      if (!isSelected) selection.clear();
      else if (total > 0) {
        const last = Math.min(total, MOST_SELECTED) - 1;
        selection.set(fetchRowsBetween(search, 0, last), true);
      }
    },
    selectGroup: (group, isSelected) => selection.set(lines.runsOfGroup(group), isSelected),
    selectedIn: (group) => selection.runs.filter((run) => isIn(run, group)).length,
    extend: (from, to) =>
      selection.set(lines.runsBetween({ first: Math.min(from, to), last: Math.max(from, to) }), true),
    enter: (index, isOpen) => {
      const line = lines.lineAt(index);
      if (line.kind === 'group' && isOpen !== line.isOpen) {
        const others = (search.open ?? []).filter((id) => id !== line.id);
        onChange({ open: line.isOpen ? none(others) : [...others, line.id] });
      } else if (line.kind === 'run' && isOpen === undefined) {
        void navigate({ to: '/runs/$runId', params: { runId: line.run.id } });
      }
    },
    pickTag: (tag) => onChange({ tag: [...new Set([...(search.tag ?? []), tag])] }),
  };
}

/** Whether a run belongs to a group. */
function isIn(run: RunSummary, group: RunGroup): boolean {
  return Object.entries(group.keys).every(
    ([key, value]) => run[key === 'settings' ? 'settings_hash' : (key as keyof RunSummary)] === value,
  );
}

function none<T>(list: readonly T[]): readonly T[] | undefined {
  return list.length === 0 ? undefined : list;
}
