/** What can be asked of a run, and what to say of what became of it. */
import type { ActionResult, RunActions, RunSummary } from '@/client/schema.gen';
import { formatPlural } from '@/lib/format';

export type Action = RunActions['action'];

/** What decides which actions make sense. */
export type Actable = Pick<
  RunSummary,
  'id' | 'phase' | 'state' | 'cancel_requested' | 'pause_requested' | 'is_below_gate' | 'deleted_at'
>;

/** Every action, the gentle ones first. */
export const ACTIONS: readonly Action[] = ['resume', 'release', 'retry', 'pause', 'cancel', 'delete', 'restore'];

/** What a button says. */
export const ACTION_NAMES: Record<Action, string> = {
  resume: 'Resume',
  release: 'Release anyway',
  retry: 'Retry',
  pause: 'Pause',
  cancel: 'Cancel',
  delete: 'Delete',
  restore: 'Restore',
};

/** What an action does, in one sentence. */
export const ACTION_MEANING: Record<Action, string> = {
  resume: 'Let it go on, from its checkpoint if it has one.',
  release: 'Start it although its locomotion model missed the gate.',
  retry: 'Try it again, from its last checkpoint.',
  pause: 'Save a checkpoint at the end of the cycle and free the slot.',
  cancel: 'End it within seconds; what was learnt since the last checkpoint is lost.',
  delete: 'Hide it from every list; this can be undone, and frees no disk.',
  restore: 'Bring it back as it was.',
};

const DONE_WORDS: Record<Action, string> = {
  resume: 'resumed',
  release: 'released',
  retry: 'queued again',
  pause: 'paused or about to pause',
  cancel: 'cancelled or about to end',
  delete: 'deleted',
  restore: 'restored',
};

/** Whether an action makes sense for a run, as far as the page knows; the server has the last word. */
export function allows(run: Actable, action: Action): boolean {
  if (run.deleted_at !== null) return action === 'restore';
  const { state, cancel_requested } = run;
  const isWaiting = state === 'blocked' || state === 'queued';
  switch (action) {
    case 'resume':
      return state === 'paused' || (state === 'running' && run.pause_requested && !cancel_requested);
    case 'release':
      return run.is_below_gate;
    case 'retry':
      return state === 'failed' || state === 'cancelled';
    case 'pause':
      return isWaiting || (state === 'running' && !cancel_requested && !run.pause_requested);
    case 'cancel':
      return isWaiting || state === 'paused' || (state === 'running' && !cancel_requested);
    case 'delete':
      return state !== 'running';
    case 'restore':
      return false;
  }
}

/** Of several runs, those for which an action makes sense. */
export function allowing<Run extends Actable>(runs: readonly Run[], action: Action): Run[] {
  return runs.filter((run) => allows(run, action));
}

/** What became of an action: one sentence, and why it was not done for some. */
export function summarise(
  action: Action,
  results: readonly ActionResult[],
): { text: string; details: string[]; isProblem: boolean; doneIds: string[] } {
  const done = results.filter((result) => result.done);
  const refused = results.filter((result) => !result.done).map((result) => result.message);
  const [only] = results;
  const doneIds = done.map((result) => result.run_id);
  if (results.length === 1 && only !== undefined) {
    return { text: only.message, details: [], isProblem: !only.done, doneIds };
  }
  const count = refused.length === 0 ? formatPlural(done.length, 'run') : `${done.length} of ${results.length} runs`;
  const text = `${count} ${DONE_WORDS[action]}.`;
  return { text, details: shortened(refused), isProblem: refused.length > 0, doneIds };
}

/** Of many sentences, as many as a notice can hold. */
const MOST_DETAILS = 3;

function shortened(details: readonly string[]): string[] {
  const more = details.length - MOST_DETAILS;
  return more > 0 ? [...details.slice(0, MOST_DETAILS), `and ${more} more`] : [...details];
}
