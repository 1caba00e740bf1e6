"""Requests that are too large, answered like every other error: what counts them stops them with a bare word."""

from __future__ import annotations

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from backend.api.errors import problem, problem_answer

TOO_LARGE = 413


class LargeBodies:
    """Put a sentence into the answer to a request that is too large."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer as the app does, with another body where it refuses a request for its size."""
        replaced = False

        async def send_in_words(message: Message) -> None:
            nonlocal replaced
            if message["type"] == "http.response.start" and message["status"] == TOO_LARGE:
                kind = Headers(raw=message["headers"]).get("content-type", "")
                replaced = not kind.startswith("application/json")
                if replaced:
                    sentence = "The request is larger than this address takes."
                    await problem_answer(TOO_LARGE, [problem(sentence)])(scope, receive, send)
            if not replaced:
                await send(message)

        await self._app(scope, receive, send_in_words)
