/** Drive a 3D view: commands go to its session over a websocket, states and answers come back. */

/** What every 3D view tells of its clock. */
export interface TransportState {
  readonly step: number;
  /** The last step there is. */
  readonly steps: number;
  readonly playing: boolean;
  /** Simulated seconds per second. */
  readonly speed: number;
  readonly loop: boolean;
}

/** What a view tells with every frame; each kind adds its own. */
export interface SceneState extends TransportState {
  readonly [name: string]: unknown;
}

/** Something to do: `do` names it, the rest says how. */
export interface SceneCommand {
  readonly do: string;
  readonly [name: string]: unknown;
}

interface Message {
  readonly state?: SceneState;
  readonly id?: number | null;
  readonly answer?: unknown;
  readonly error?: string;
}

interface Waiting {
  readonly resolve: (answer: unknown) => void;
  readonly reject: (error: Error) => void;
}

/** How long after a broken connection the next is tried [ms]. */
const RETRY_MS = 1_000;

/** One connection to a session, renewed until it is closed. */
export class SceneControl {
  state: SceneState | undefined;
  readonly #address: string;
  readonly #listeners = new Set<() => void>();
  readonly #waiting = new Map<number, Waiting>();
  #socket: WebSocket | undefined;
  #lastId = 0;
  #retry: ReturnType<typeof setTimeout> | undefined;

  /** `url` is the path of the view's page, which ends with a slash. */
  constructor(url: string) {
    const address = new URL(`${url}control`, window.location.origin);
    address.protocol = address.protocol.replace('http', 'ws');
    this.#address = address.href;
    this.#open();
  }

  readonly subscribe = (listener: () => void): (() => void) => {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  };

  readonly read = (): SceneState | undefined => this.state;

  /** Ask for something, and wait for what comes of it. */
  ask<Answer>(command: SceneCommand): Promise<Answer> {
    const socket = this.#socket;
    if (socket?.readyState !== WebSocket.OPEN) return Promise.reject(new Error('The 3D view is not connected yet.'));
    const id = ++this.#lastId;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve: resolve as (answer: unknown) => void, reject });
      socket.send(JSON.stringify({ ...command, id }));
    });
  }

  close(): void {
    clearTimeout(this.#retry);
    const socket = this.#socket;
    this.#socket = undefined;
    socket?.close();
    this.#rejectAll();
  }

  #open(): void {
    const socket = new WebSocket(this.#address);
    this.#socket = socket;
    socket.onmessage = ({ data }) => this.#take(JSON.parse(String(data)) as Message);
    socket.onclose = () => {
      if (this.#socket !== socket) return;
      this.#rejectAll();
      this.#retry = setTimeout(() => this.#open(), RETRY_MS);
    };
  }

  #take({ state, id, answer, error }: Message): void {
    if (state !== undefined) {
      this.state = state;
      for (const listener of this.#listeners) listener();
    }
    const waiting = id == null ? undefined : this.#waiting.get(id);
    if (waiting === undefined || id == null) return;
    this.#waiting.delete(id);
    if (error === undefined) waiting.resolve(answer);
    else waiting.reject(new Error(error));
  }

  #rejectAll(): void {
    for (const { reject } of this.#waiting.values()) reject(new Error('The connection to the 3D view was lost.'));
    this.#waiting.clear();
  }
}
