"""The built page: served after the routes, so that every address the API does not know belongs to it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from fastapi import FastAPI, Request
from fastapi.responses import FileResponse, HTMLResponse, Response
from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from backend.api.errors import ApiError

BUILT_PAGE = Path(__file__).parents[2] / "web" / "dist"
"""Where `make web` puts the page."""

WASM_TYPE = "application/wasm"
"""Browsers compile it while it comes only under this type."""

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
        app.add_api_route("/assets/{name}.wasm", _send_wasm_below(directory), methods=["GET"], include_in_schema=False)
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


def _send_wasm_below(directory: Path) -> Callable[[str, Request], Response]:
    """Return a route for WebAssembly of the built page, which is compressed once, when the page is built."""

    def send_wasm(name: str, request: Request) -> Response:
        path = directory / "assets" / f"{name}.wasm"
        packed = path.with_name(f"{path.name}.gz")
        if not path.is_file():
            raise ApiError(404, f"There is nothing at {request.url.path}.")
        if not packed.is_file() or "gzip" not in request.headers.get("accept-encoding", ""):
            return FileResponse(path, media_type=WASM_TYPE)
        # Rerun's viewer reads how long it will be, to show how much of it has come.
        headers = {
            "content-encoding": "gzip",
            "vary": "Accept-Encoding",
            "rerun-final-length": str(path.stat().st_size),
        }
        return FileResponse(packed, media_type=WASM_TYPE, headers=headers)

    return send_wasm


def _nothing_here(request: Request) -> None:
    """Answer unknown addresses of the API with JSON, to browsers too."""
    raise ApiError(404, f"There is nothing at {request.url.path}.")


def _say_how_to_build(path: str) -> HTMLResponse:
    return HTMLResponse(NOT_BUILT, status_code=503)
