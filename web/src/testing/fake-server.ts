/** A server in the test's own process: it answers fetch from a table of routes and remembers what it was asked. */

type Answer = { status?: number; body: unknown; headers?: Record<string, string> };
type Route = (request: { url: URL; body: unknown }) => Answer | Promise<Answer>;

export interface Asked {
  readonly method: string;
  readonly path: string;
  readonly search: string;
  readonly body: unknown;
}

export class FakeServer {
  readonly asked: Asked[] = [];
  isDown = false;
  readonly #routes = new Map<string, Route>();

  /** Take the place of the browser's fetch. */
  start(): this {
    globalThis.fetch = async (input, init) => this.#answer(new Request(input, init));
    return this;
  }

  /** Answer `GET /api/runs` and the like. */
  on(route: string, answer: Route): this {
    this.#routes.set(route, answer);
    return this;
  }

  /** What was sent to a route, oldest first. */
  bodiesOf(method: string, path: string): unknown[] {
    return this.asked.filter((asked) => asked.method === method && asked.path === path).map((asked) => asked.body);
  }

  async #answer(request: Request): Promise<Response> {
    if (this.isDown) throw new TypeError('Failed to fetch');
    const url = new URL(request.url);
    const text = await request.text();
    const body: unknown = text === '' ? undefined : JSON.parse(text);
    this.asked.push({ method: request.method, path: url.pathname, search: url.search, body });
    const route = this.#routes.get(`${request.method} ${url.pathname}`);
    const answer = route ? await route({ url, body }) : problem(404, null, `The fake has no ${url.pathname}.`);
    if (answer.status === 204) return new Response(null, { status: 204 });
    return Response.json(answer.body, { status: answer.status ?? 200, headers: answer.headers });
  }
}

/** A refusal about one field. */
export function problem(status: number, field: string | null, message: string): Answer {
  return { status, body: { problems: [{ field, message }] } };
}

/** Nothing to say: it was done. */
export const DONE: Answer = { status: 204, body: null };
