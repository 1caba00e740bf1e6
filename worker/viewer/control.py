"""The control channel of a session: JSON over a websocket of this machine, beside the 3D page.

The page sends commands (`{"do": "seek", "step": 12}`, with an `"id"` if it wants to know the answer). It is told the
view's state whenever that changes (`{"state": {...}}`), and what it asked for: `{"id": 7, "answer": {...}}`, or
`{"id": 7, "error": "..."}` with one sentence. The API's proxy is the only client; pages reach it through their token.
"""

from __future__ import annotations

import asyncio
import json
import queue
import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from websockets.asyncio.server import Server, ServerConnection, broadcast, serve
from websockets.exceptions import ConnectionClosed

from worker.viewer.page import HOST

MAX_COMMAND = 64 * 1024
"""Longest command [bytes]."""

MAX_UNREAD = 4 * 1024 * 1024
"""A page that leaves so much unread misses states until it has caught up [bytes]."""

STARTED_WITHIN_S = 10.0
"""The channel listens by then [s]."""


@dataclass(frozen=True)
class Asked:
    """One message of a page, and the way back to it."""

    text: str | bytes
    answer: Callable[[Mapping[str, Any]], None]


class ControlChannel:
    """Listen on a free port in a thread of its own; the session's loop takes the messages and tells the state.

    Attributes:
        port: where it listens on 127.0.0.1.
        pages: pages that are connected.
    """

    def __init__(self) -> None:
        self.port = 0
        self._asked: queue.SimpleQueue[Asked] = queue.SimpleQueue()
        self._connections: set[ServerConnection] = set()
        self._state = ""
        self._loop = asyncio.new_event_loop()
        self._server: Server | None = None
        listening = threading.Event()
        self._thread = threading.Thread(target=self._run, args=(listening,), name="control", daemon=True)
        self._thread.start()
        if not listening.wait(STARTED_WITHIN_S):
            raise TimeoutError(f"the control channel did not listen within {STARTED_WITHIN_S:.0f} s")

    @property
    def pages(self) -> int:
        """Pages that are connected now."""
        return len(self._connections)

    def ask(self, command: Mapping[str, Any]) -> None:
        """Ask for something from within this process; nobody hears the answer."""
        self._asked.put(Asked(to_json(command), lambda answer: None))

    def take(self, patience_s: float) -> list[Asked]:
        """Return the messages that have come, in order; wait for the first so long at most [s]."""
        taken: list[Asked] = []
        try:
            taken.append(self._asked.get(timeout=patience_s))
            while True:
                taken.append(self._asked.get_nowait())
        except queue.Empty:
            return taken

    def publish(self, state: Mapping[str, Any]) -> None:
        """Tell every page the state if it has changed."""
        text = to_json({"state": state})
        if text != self._state:
            self._state = text
            self._loop.call_soon_threadsafe(self._tell_all, text)

    def close(self) -> None:
        """Stop listening and end the thread."""
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()

    def _run(self, listening: threading.Event) -> None:
        asyncio.set_event_loop(self._loop)
        self._server = self._loop.run_until_complete(self._listen())
        self.port = next(iter(self._server.sockets)).getsockname()[1]
        listening.set()
        self._loop.run_forever()
        self._server.close()
        self._loop.run_until_complete(self._server.wait_closed())
        self._loop.close()

    async def _listen(self) -> Server:
        # A browser always names its origin: only programs of this machine, such as the proxy, get through.
        return await serve(self._serve, HOST, 0, origins=[None], compression=None, max_size=MAX_COMMAND)

    async def _serve(self, connection: ServerConnection) -> None:
        self._connections.add(connection)
        try:
            if self._state:
                await connection.send(self._state)
            async for message in connection:
                self._asked.put(Asked(message, lambda answer: self._send(connection, answer)))
        except ConnectionClosed:
            pass
        finally:
            self._connections.discard(connection)

    def _send(self, connection: ServerConnection, message: Mapping[str, Any]) -> None:
        self._loop.call_soon_threadsafe(broadcast, [connection], to_json(message))

    def _tell_all(self, text: str) -> None:
        broadcast([page for page in self._connections if page.transport.get_write_buffer_size() < MAX_UNREAD], text)


def to_json(message: Mapping[str, Any]) -> str:
    """Return a message as JSON; numbers of numpy and whole arrays are written as they are, to the last bit."""
    return json.dumps(message, default=_plain, allow_nan=False)


def _plain(value: Any) -> Any:
    """Return numpy's numbers and arrays as Python's."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} cannot be written as JSON")
