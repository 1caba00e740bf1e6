"""Same-origin rule: another site's page may neither change anything here nor open a websocket."""

from __future__ import annotations

from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket

from backend.api.errors import problem, problem_answer

HARMLESS_METHODS = frozenset({"GET", "HEAD", "OPTIONS"})

OWN_SITES = frozenset({"same-origin", "none"})
"""What `Sec-Fetch-Site` says of our own page, and of an address that a person typed."""


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

    Browsers send an Origin with websockets and with changes and say in `Sec-Fetch-Site` who asks; programs do neither.
    Other ports of this machine count as the same site, so a cookie's SameSite alone would let their pages in.
    """
    headers = Headers(scope=scope)
    site = headers.get("sec-fetch-site")
    if scope["type"] == "http" and scope["method"] in HARMLESS_METHODS:
        return site is None or site in OWN_SITES or headers.get("sec-fetch-mode") == "navigate"
    origin = headers.get("origin")
    if origin is not None:
        return _place(origin) == headers.get("host", "").lower()
    if scope["type"] == "websocket":
        return False
    return site == "same-origin" or (site is None and ("authorization" in headers or "cookie" not in headers))


def _place(origin: str) -> str | None:
    """Return host and port of an Origin; None if it is none."""
    try:
        return urlsplit(origin).netloc.lower()
    except ValueError:
        return None
