/** What the run states mean for the page. */
import type { RunState } from '@/client/schema.gen';

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
  blocked: 'Waits for another run.',
  queued: 'Waits for a free worker.',
  running: 'A worker trains it.',
  paused: 'Checkpointed; waits for a person.',
  succeeded: 'Trained to its end.',
  failed: 'Ended by an error.',
  cancelled: 'Ended by a person.',
};
