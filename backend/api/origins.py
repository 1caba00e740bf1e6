"""Same-origin rule: another site's page may neither change anything here nor open a websocket."""

from __future__ import annotations

from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket

from backend.api.errors import problem, problem_answer

HARMLESS_METHODS = frozenset({"GET", "HEAD", "OPTIONS"})


class SameOrigin:
    """Refuse changes and websockets that a page of another origin asks for."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on what is allowed, answer 403 to the rest."""
        if scope["type"] == "lifespan" or is_allowed(scope):
            await self._app(scope, receive, send)
            return
        message = "This is only possible from a page of this server; open it there."
        answer = problem_answer(403, [problem(message)])
        if scope["type"] == "websocket":
            await WebSocket(scope, receive, send).send_denial_response(answer)
        else:
            await answer(scope, receive, send)


def is_allowed(scope: Scope) -> bool:
    """Tell whether a request comes from our own page, or from a program where programs are welcome.

    Browsers always send an Origin with websockets and with changes; only programs leave it out.
    """
    headers = Headers(scope=scope)
    origin = headers.get("origin")
    if scope["type"] == "http" and (scope["method"] in HARMLESS_METHODS or origin is None):
        return True
    return origin is not None and urlsplit(origin).netloc.lower() == headers.get("host", "").lower()
