/** A line of the table: a run, a group of runs, or a place for what is still on its way. */
import type { RunGroup, RunSummary } from '@/client/schema.gen';
import type { RunsSearch } from './search';

export type Values = readonly (number | null)[];

export type Line =
  | { readonly kind: 'run'; readonly run: RunSummary; readonly values: Values; readonly isInGroup: boolean }
  | { readonly kind: 'group'; readonly id: string; readonly group: RunGroup; readonly isOpen: boolean }
  /** The runs of an open group that do not fit under it. */
  | { readonly kind: 'more'; readonly count: number; readonly search: RunsSearch }
  | { readonly kind: 'loading' };

/** Lines in view, both included. */
export interface Range {
  readonly first: number;
  readonly last: number;
}

/** Runs at once where they are at hand, else once they are fetched. */
export type SomeRuns = readonly RunSummary[] | Promise<readonly RunSummary[]>;

/** All lines of a table, of which those in view are at hand. */
export interface Lines {
  readonly count: number;
  /** Runs that pass the filters, shown or not; unknown until the first answer. */
  readonly total: number | undefined;
  readonly updatedAt: number;
  readonly error: Error | null;
  lineAt: (index: number) => Line;
  /** The line of a run that is at hand, or -1. */
  indexOf: (id: string) => number;
  /** A run that is at hand. */
  findRun: (id: string) => RunSummary | undefined;
  /** The runs between two lines, both included. */
  runsBetween: (range: Range) => SomeRuns;
  runsOfGroup: (group: RunGroup) => SomeRuns;
}

export const LOADING: Line = { kind: 'loading' };

/** What stands between two lines whose runs are all at hand. */
export function runsAmong(lines: readonly Line[]): RunSummary[] {
  return lines.flatMap((line) => (line.kind === 'run' ? [line.run] : []));
}

/** Pages that have a line in view. */
export function pagesIn({ first, last }: Range, pageSize: number): number[] {
  const start = Math.max(0, Math.floor(first / pageSize));
  const end = Math.max(start, Math.floor(last / pageSize));
  return Array.from({ length: end - start + 1 }, (_, i) => start + i);
}
