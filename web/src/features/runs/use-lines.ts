/** The lines of the table as it stands in the address: runs one after the other, or in groups. */
import { useQueries, useQuery } from '@tanstack/react-query';
import type { RunGroup, RunPage, RunSummary } from '@/client/schema.gen';
import { groupId, groupsQuery, searchOfGroup } from './api/list-groups';
import { fetchRowsBetween, PAGE_SIZE, runsPageQuery } from './api/list-runs';
import { type Line, type Lines, LOADING, pagesIn, type Range, runsAmong } from './lines';
import type { RunsSearch } from './search';

/** @param shown the lines in view */
export function useLines(search: RunsSearch, shown: Range): Lines {
  const isGrouped = search.group !== undefined;
  const runs = useRunLines(search, shown, !isGrouped);
  const groups = useGroupLines(search, isGrouped);
  return isGrouped ? groups : runs;
}

function useRunLines(search: RunsSearch, shown: Range, isWanted: boolean): Lines {
  const first = useQuery({ ...runsPageQuery(search, 0), enabled: isWanted });
  const numbers = pagesIn(shown, PAGE_SIZE).filter((page) => page > 0);
  const others = useQueries({
    queries: numbers.map((page) => ({ ...runsPageQuery(search, page), enabled: isWanted })),
  });
  const pages = new Map<number, RunPage | undefined>([
    [0, first.data],
    ...numbers.map((page, at) => [page, others[at]?.data] as const),
  ]);
  const lineAt = (index: number): Line => lineOf(pages.get(Math.floor(index / PAGE_SIZE)), index % PAGE_SIZE);
  const total = first.data?.total;
  return {
    count: total ?? 0,
    total,
    updatedAt: first.dataUpdatedAt,
    error: first.data === undefined ? first.error : null,
    lineAt,
    indexOf: (id) => {
      for (const [number, page] of pages) {
        const row = page?.runs.findIndex((run) => run.id === id) ?? -1;
        if (row !== -1) return number * PAGE_SIZE + row;
      }
      return -1;
    },
    findRun: (id) => found(pages.values(), id),
    runsBetween: (range) => {
      const lines = Array.from({ length: range.last - range.first + 1 }, (_, i) => lineAt(range.first + i));
      const isAtHand = lines.every((line) => line.kind === 'run');
      return isAtHand ? runsAmong(lines) : fetchRowsBetween(search, range.first, range.last);
    },
    runsOfGroup: () => [],
  };
}

/** Runs that an open group shows; there are rarely more that differ in the seed alone. */
const MOST_IN_GROUP = PAGE_SIZE;

function useGroupLines(search: RunsSearch, isWanted: boolean): Lines {
  const { data, dataUpdatedAt, error } = useQuery({ ...groupsQuery(search), enabled: isWanted });
  const by = search.group ?? [];
  const groups = data?.groups ?? [];
  const open = groups.filter((group) => search.open?.includes(groupId(group, by)));
  const members = useQueries({
    queries: open.map((group) => ({ ...runsPageQuery(searchOfGroup(search, group), 0), enabled: isWanted })),
  });
  const pageOf = (group: RunGroup): RunPage | undefined => members[open.indexOf(group)]?.data;
  const lines = groups.flatMap((group): Line[] => {
    const isOpen = open.includes(group);
    const head: Line = { kind: 'group', id: groupId(group, by), group, isOpen };
    return isOpen ? [head, ...membersOf(pageOf(group), group, searchOfGroup(search, group))] : [head];
  });
  return {
    count: lines.length,
    total: data?.total,
    updatedAt: dataUpdatedAt,
    error: data === undefined ? error : null,
    lineAt: (index) => lines[index] ?? LOADING,
    indexOf: (id) => lines.findIndex((line) => line.kind === 'run' && line.run.id === id),
    findRun: (id) => found(open.map(pageOf), id),
    runsBetween: ({ first, last }) => runsAmong(lines.slice(first, last + 1)),
    runsOfGroup: (group) => {
      // What is known of a group that was closed since may be as old as the closing.
      const { data: known, isPlaceholderData = true } = members[open.indexOf(group)] ?? {};
      if (known !== undefined && !isPlaceholderData && known.total <= MOST_IN_GROUP) return known.runs;
      return fetchRowsBetween(searchOfGroup(search, group), 0, group.runs - 1);
    },
  };
}

function lineOf(page: RunPage | undefined, row: number, isInGroup = false): Line {
  const run = page?.runs[row];
  return run === undefined ? LOADING : { kind: 'run', run, values: page?.values[row] ?? [], isInGroup };
}

function membersOf(page: RunPage | undefined, group: RunGroup, search: RunsSearch): Line[] {
  if (page === undefined) return Array<Line>(Math.min(group.runs, MOST_IN_GROUP)).fill(LOADING);
  const rest = page.total - page.runs.length;
  const lines = page.runs.map((_, row) => lineOf(page, row, true));
  return rest > 0 ? [...lines, { kind: 'more', count: rest, search }] : lines;
}

function found(pages: Iterable<RunPage | undefined>, id: string): RunSummary | undefined {
  for (const page of pages) {
    const run = page?.runs.find((one) => one.id === id);
    if (run !== undefined) return run;
  }
  return undefined;
}
