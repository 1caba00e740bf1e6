/** What the run states mean for the page. */
import type { RunState, RunSummary } from '@/client/schema.gen';

/** Every state, in the order a run goes through them. */
export const RUN_STATES: readonly RunState[] = [
  'blocked',
  'queued',
  'running',
  'paused',
  'succeeded',
  'failed',
  'cancelled',
];

/** Whether nothing will change any more. */
export function hasEnded(state: RunState): boolean {
  return state === 'succeeded' || state === 'failed' || state === 'cancelled';
}

/** What a state means, in one sentence. */
export const STATE_MEANING: Record<RunState, string> = {
  blocked: 'Waits for another run, or below its gate.',
  queued: 'Waits for a free worker.',
  running: 'A worker trains it.',
  paused: 'Held until a person resumes it.',
  succeeded: 'Trained to its end, here or before it was brought in.',
  failed: 'Ended by an error.',
  cancelled: 'Ended by a person.',
};

/** What a running run has been asked for and will do soon. */
export type Wish = 'cancelling' | 'pausing';

/** What a person has asked of a running run and its worker has not done yet. */
export function wishOf(run: Pick<RunSummary, 'state' | 'cancel_requested' | 'pause_requested'>): Wish | undefined {
  if (run.state !== 'running') return undefined;
  if (run.cancel_requested) return 'cancelling';
  return run.pause_requested ? 'pausing' : undefined;
}

/** What follows from a wish. */
export const WISH_MEANING: Record<Wish, string> = {
  cancelling: 'It will end at its next step.',
  pausing: 'It will save a checkpoint at the end of its cycle and wait.',
};
