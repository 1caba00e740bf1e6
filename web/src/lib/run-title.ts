/** What a run is called: there are no names to think up, its settings name it. */
import type { RunSummary } from '@/client/schema.gen';

/** `FetchPush manipulation, her-sldr, seed 0`. */
export function runTitle(run: Pick<RunSummary, 'task' | 'phase' | 'method' | 'seed'>): string {
  return `${run.task} ${run.phase}, ${run.method}, seed ${run.seed}`;
}
