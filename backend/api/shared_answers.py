"""Answers that are the same for everybody: made once for all who ask within a moment, and sent once to each.

Pages ask for live data every two seconds and say that an answer may be a second old (`Cache-Control: max-age=1`,
RFC 9111 section 5.2.1.1). With fifty pages open, most of what they ask has just been answered to another one. Programs
that say nothing get a new answer each time, and so does everybody after a change that was made through this server.
"""

from __future__ import annotations

import asyncio
import time
from collections import OrderedDict
from dataclasses import dataclass
from hashlib import blake2b
from typing import Any

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from backend.api.access.declarations import declaration_of
from backend.api.freshness import accepted_age

MOST_ANSWERS = 256
"""Answers that are kept; beyond, the one that was asked for longest ago is forgotten."""
LARGEST_BODY = 2**20
"""Longer answers are made anew each time [bytes]."""

GZIP_TIME = slice(4, 8)
"""Where gzip notes the time (RFC 1952 section 2.3.1): two answers that differ only there are the same."""

NOT_IN_304 = ("content-length", "content-encoding", "content-type")

Key = tuple[str, bytes, str]
"""Path, query and the encodings that whoever asks can read."""


@dataclass(frozen=True)
class Answer:
    """Keep an answer as it was sent, and what it was made from."""

    headers: list[tuple[bytes, bytes]]
    body: bytes
    etag: str
    made_at: float
    """Not later than what it tells of was read [s of the monotonic clock]."""
    writes: int
    """How often this process had written into the store by then."""
    route: Any
    """The route that made it, for whoever counts requests by route."""


class SharedAnswers:
    """Give an answer again while it is young enough for whoever asks; it stands behind the gate."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app
        self._answers: OrderedDict[Key, Answer] = OrderedDict()
        self._being_made: dict[Key, asyncio.Event] = {}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer from memory if that is good enough, and as the app does otherwise."""
        if scope["type"] != "http" or scope["method"] != "GET":
            await self._app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        key = (scope["path"], scope["query_string"], headers.get("accept-encoding", ""))
        accepted_s = accepted_age(headers)
        known = self._find(key, scope, accepted_s)
        # Only what is known to be shared is waited for.
        while known is None and accepted_s and key in self._answers and (turn := self._being_made.get(key)):
            await turn.wait()
            known = self._find(key, scope, accepted_s)
        if known is None:
            await self._make(key, scope, receive, send)
        else:
            scope["route"] = known.route
            await _send(known, headers, send)

    def _find(self, key: Key, scope: Scope, accepted_s: float) -> Answer | None:
        answer = self._answers.get(key)
        if answer is None or not accepted_s:
            return None
        self._answers.move_to_end(key)
        is_young = time.monotonic() - answer.made_at <= accepted_s
        return answer if is_young and answer.writes == _writes(scope) else None

    async def _make(self, key: Key, scope: Scope, receive: Receive, send: Send) -> None:
        made_at, writes = time.monotonic(), _writes(scope)
        turn = self._being_made[key] = asyncio.Event()
        collector = _Collector(scope, send)
        try:
            await self._app(scope, receive, collector)
        finally:
            turn.set()
            if self._being_made.get(key) is turn:
                del self._being_made[key]
        if collector.start is None:
            return
        answer = _answer(collector.start, collector.body, made_at, writes, scope.get("route"))
        self._answers[key] = answer
        self._answers.move_to_end(key)
        while len(self._answers) > MOST_ANSWERS:
            self._answers.popitem(last=False)
        await _send(answer, Headers(scope=scope), send)


class _Collector:
    """Hold back a good answer of a shared route, and pass on every other."""

    def __init__(self, scope: Scope, send: Send) -> None:
        self._scope = scope
        self._send = send
        self.start: Message | None = None
        """The beginning of the answer that is held back."""
        self.body = b""

    async def __call__(self, message: Message) -> None:
        if message["type"] == "http.response.start":
            declared = declaration_of(self._scope.get("endpoint"))
            if declared is not None and declared.is_shared and message["status"] == 200:
                self.start = message
                return
        elif self.start is not None:
            self.body += message.get("body", b"")
            if len(self.body) <= LARGEST_BODY:
                return
            await self._send(self.start)
            message, self.start = {**message, "body": self.body}, None
        await self._send(message)


def _writes(scope: Scope) -> int:
    return scope["app"].state.service.database.writes


def _answer(start: Message, body: bytes, made_at: float, writes: int, route: object) -> Answer:
    headers = MutableHeaders(raw=list(start["headers"]))
    is_gzip = headers.get("content-encoding") == "gzip"
    content = body[: GZIP_TIME.start] + body[GZIP_TIME.stop :] if is_gzip else body
    etag = f'W/"{blake2b(content, digest_size=12).hexdigest()}"'
    headers["etag"] = etag
    # A browser keeps it, and asks each time whether it still holds.
    headers["cache-control"] = "private, no-cache"
    return Answer(headers.raw, body, etag, made_at, writes, route)


async def _send(answer: Answer, asked: Headers, send: Send) -> None:
    is_known = answer.etag in {tag.strip() for tag in asked.get("if-none-match", "").split(",")}
    # Whoever stands before it writes headers of this one request.
    headers = [(name, value) for name, value in answer.headers if not is_known or name.decode() not in NOT_IN_304]
    await send({"type": "http.response.start", "status": 304 if is_known else 200, "headers": headers})
    await send({"type": "http.response.body", "body": b"" if is_known else answer.body})
