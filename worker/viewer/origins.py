"""Which pages may open a websocket to Viser: none that a browser has from elsewhere."""

from __future__ import annotations

import http
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from urllib.parse import urlsplit

from websockets.asyncio import server
from websockets.asyncio.server import ServerConnection
from websockets.http11 import Request, Response

THIS_MACHINE = frozenset({"127.0.0.1", "localhost"})
"""What a page of this machine may be called by: any other name could be made to lead here by whoever owns it."""


@contextmanager
def refusing_other_pages(allow_own: bool) -> Iterator[None]:
    """Let servers that start within the block refuse websockets of foreign pages; Viser lets all of them in.

    Args:
        allow_own: whether the page that the server itself serves may connect; else only programs may, such as a proxy.
    """
    serve = server.serve

    def serve_guarded(*arguments: Any, process_request: Any, **options: Any) -> server.serve:
        def check(connection: ServerConnection, request: Request) -> Response | None:
            if _is_websocket(request) and not is_welcome(request, allow_own):
                return connection.respond(http.HTTPStatus.FORBIDDEN, "A page of another site may not look at this.\n")
            return process_request(connection, request)

        return serve(*arguments, process_request=check, **options)

    server.serve = serve_guarded
    try:
        yield
    finally:
        server.serve = serve


def is_welcome(request: Request, allow_own: bool) -> bool:
    """Tell whether a program asks, or the page that was served here. A browser always names its origin."""
    host = request.headers.get("Host")
    return all(allow_own and _is_own(origin, host) for origin in request.headers.get_all("Origin"))


def _is_own(origin: str, host: str | None) -> bool:
    parts = urlsplit(origin)
    return parts.netloc == host and parts.hostname in THIS_MACHINE


def _is_websocket(request: Request) -> bool:
    return request.headers.get("Upgrade", "").lower() == "websocket"
