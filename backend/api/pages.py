"""The built page: served after the routes, so that every address the API does not know belongs to it."""

from __future__ import annotations

from pathlib import Path

from fastapi import FastAPI, Request
from fastapi.responses import HTMLResponse
from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from backend.api.errors import ApiError

BUILT_PAGE = Path(__file__).parents[2] / "web" / "dist"
"""Where `make web` puts the page."""

NOT_BUILT = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<title>SLDR</title>
<body style="font: 1rem/1.5 system-ui; max-width: 40rem; margin: 4rem auto; padding: 0 1rem">
<h1>The page is not built yet</h1>
<p>Run <code>make web</code> and start the server again. The API is already here, under <code>/api</code>.</p>
"""


def add_pages(app: FastAPI, directory: Path) -> None:
    """Serve the built page from `directory`, or a page that says how to build it."""
    for path in ("/api", "/api/{path:path}"):
        app.add_api_route(path, _nothing_here, methods=["GET"], include_in_schema=False)
    app.add_middleware(CacheRules)
    if (directory / "index.html").is_file():
        app.frontend("/", directory=directory, fallback="index.html")
    else:
        app.add_api_route("/{path:path}", _say_how_to_build, include_in_schema=False)


class CacheRules:
    """Let browsers keep what carries a hash in its name for good, and ask again for everything else."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer as the app does, with a Cache-Control header where it set none."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        hashed = scope["path"].startswith("/assets/")

        async def send_with_rule(message: Message) -> None:
            if message["type"] == "http.response.start":
                lasting = hashed and message["status"] < 400
                rule = "public, max-age=31536000, immutable" if lasting else "no-cache"
                MutableHeaders(scope=message).setdefault("Cache-Control", rule)
            await send(message)

        await self._app(scope, receive, send_with_rule)


def _nothing_here(request: Request) -> None:
    """Answer unknown addresses of the API with JSON, to browsers too."""
    raise ApiError(404, f"There is nothing at {request.url.path}.")


def _say_how_to_build(path: str) -> HTMLResponse:
    return HTMLResponse(NOT_BUILT, status_code=503)
