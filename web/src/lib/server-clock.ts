/** What time it is by the server's clock, whose moments the page shows: the browser's may be off. */

/** A `Date` header has whole seconds and is made anew each second, so it is at most so old when it is sent [ms]. */
const OLDEST_MS = 2_000;

/** A clock that is off by less is taken for right: nobody sees that little, and the header tells no more [ms]. */
const TOLERATED_MS = 3_000;

/** How far the server's clock is ahead of the browser's, as far as the answers so far ask for [ms]. */
let ahead = 0;

/**
 * Learn from the `Date` header of an answer.
 * @param askedAt when it was asked for by the browser's clock [ms]
 * @param answeredAt when it came by the browser's clock [ms]
 */
export function learnServerTime(date: string | null, askedAt: number, answeredAt: number): void {
  const told = Date.parse(date ?? '');
  if (Number.isNaN(told)) return;
  // It was sent at some time in between, so the answer leaves a span of clocks; a slow one leaves a wide span.
  ahead = Math.min(Math.max(ahead, told - answeredAt), told + OLDEST_MS - askedAt);
}

/** The server's time now [ms]. */
export function serverNow(): number {
  return Date.now() + (Math.abs(ahead) < TOLERATED_MS ? 0 : ahead);
}
