/** The runs table's filters, as they stand in the address. */
import type { RunState } from '@/client/schema.gen';
import { RUN_STATES } from '@/lib/states';

/** What the runs table is narrowed to. */
export interface RunsSearch {
  readonly state?: RunState;
  readonly task?: string;
  readonly phase?: 'locomotion' | 'manipulation';
  readonly method?: string;
  readonly search?: string;
}

/** Read the filters from an address; what makes no sense is left out. */
export function readRunsSearch(raw: Record<string, unknown>): RunsSearch {
  const text = (key: string): string | undefined => {
    const value = raw[key];
    return value === undefined || value === null || value === '' ? undefined : String(value);
  };
  const phase = text('phase');
  return {
    state: RUN_STATES.find((state) => state === raw.state),
    task: text('task'),
    phase: phase === 'locomotion' || phase === 'manipulation' ? phase : undefined,
    method: text('method'),
    search: text('search')?.slice(0, 200),
  };
}

/** Whether anything is left out of the table. */
export function isNarrowed(search: RunsSearch): boolean {
  return Object.values(search).some((value) => value !== undefined);
}
