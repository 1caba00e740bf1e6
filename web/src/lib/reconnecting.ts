/** Ask again by itself for what could not be fetched because the server did not answer. */
import { Unreachable } from '@/lib/api';

/** How often a server that does not answer is asked again [ms]. */
export const RECONNECT_MS = 3_000;

/** The interval of requests that are not renewed otherwise. */
export function reconnecting({ state }: { state: { error: unknown } }): number | false {
  return state.error instanceof Unreachable ? RECONNECT_MS : false;
}
