/** Talk to the server: one client, and one kind of error that a person can read. */
import createClient from 'openapi-fetch';
import type { Problem, paths } from '@/client/schema.gen';
import { learnServerTime } from '@/lib/server-clock';

// fetch is looked up at each call, so that a test may replace it.
export const client = createClient<paths>({
  baseUrl: typeof window === 'undefined' ? '' : window.location.origin,
  // Many pages ask for the same within a second: the server may answer all with one answer.
  headers: { 'Cache-Control': 'max-age=1' },
  fetch: async (request) => {
    const askedAt = Date.now();
    const response = await globalThis.fetch(request);
    learnServerTime(response.headers.get('date'), askedAt, Date.now());
    return response;
  },
});

/** The server refused a request and said why. */
export class Refused extends Error {
  readonly status: number;
  readonly problems: readonly Problem[];

  constructor(status: number, problems: readonly Problem[]) {
    super(problems.map((problem) => problem.message).join(' '));
    this.name = 'Refused';
    this.status = status;
    this.problems = problems;
  }
}

/** The server could not be reached at all. */
export class Unreachable extends Error {
  constructor(cause: unknown) {
    super('The server does not answer. Check that `sldr serve` is still running; this page reconnects by itself.', {
      cause,
    });
    this.name = 'Unreachable';
  }
}

/** What a proxy answers in place of a server that is away. */
const AWAY: readonly number[] = [502, 503, 504];

interface Answer<T> {
  data?: T;
  error?: unknown;
  response: Response;
}

/** Wait for an answer and return its body; throw `Refused` or `Unreachable` otherwise. */
export async function unwrap<T>(request: Promise<Answer<T>>): Promise<NonNullable<T>> {
  const { data, error, response } = await request.catch((cause: unknown) => {
    if (cause instanceof DOMException && cause.name === 'AbortError') throw cause;
    throw new Unreachable(cause);
  });
  if (AWAY.includes(response.status) && !isRefusal(error)) throw new Unreachable(`status ${response.status}`);
  if (!response.ok) throw new Refused(response.status, problemsOf(error, response.status));
  return data as NonNullable<T>;
}

/** What went wrong, in one sentence for a person. */
export function sentence(error: unknown): string {
  return error instanceof Error ? error.message : 'Something went wrong that has no name. Reload the page.';
}

/** What a refusal's body says, or one sentence in place of a body that says nothing. */
export function problemsOf(body: unknown, status: number): readonly Problem[] {
  if (isRefusal(body)) return body.problems;
  return [{ field: null, message: `The server answered with status ${status}. Its log says why.` }];
}

function isRefusal(body: unknown): body is { problems: Problem[] } {
  return typeof body === 'object' && body !== null && 'problems' in body && Array.isArray(body.problems);
}
