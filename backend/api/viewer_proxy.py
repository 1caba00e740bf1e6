"""Reverse proxy to the 3D servers: page and websocket of a session, below one signed address.

Viser listens on this machine only and knows no login; whoever holds a session's token reaches it through here.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from html import escape
from urllib.parse import quote

import httpx
from fastapi import APIRouter, Request, WebSocket
from fastapi.responses import HTMLResponse, RedirectResponse, Response
from starlette.concurrency import run_in_threadpool
from starlette.websockets import WebSocketDisconnect
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake
from websockets.typing import Subprotocol

from backend.api.access.callers import Refusal, find_caller
from backend.api.access.declarations import needs
from backend.api.dependencies import Service, ServiceParts
from backend.api.errors import problem, problem_answer
from backend.api.tokens import BadToken
from backend.store import viewer_sessions
from backend.store.errors import NotFound, StoreUnavailable

log = logging.getLogger("sldr.api.viewer")

VISER_HOST = "127.0.0.1"
"""3D servers never listen elsewhere."""

ANSWER_TIMEOUT_S = 10.0
"""How long a 3D server may take to answer [s]."""

ASK_AGAIN_S = 2
"""After this a page that is not there yet is asked for again [s]."""

TOUCH_INTERVAL_S = 5.0
"""How often an open view tells the store that somebody watches, and asks whether it may go on [s]."""

FORWARDED_REQUEST_HEADERS = ("accept", "accept-encoding", "if-none-match", "range")
FORWARDED_ANSWER_HEADERS = ("content-type", "content-encoding", "etag", "content-range", "cache-control")

router = APIRouter(prefix="/viewer", include_in_schema=False)


class NoView(Exception):
    """Report that there is nothing to watch: status, one sentence for the user, and whether that may pass by itself."""

    def __init__(self, status: int, message: str, may_pass: bool = False) -> None:
        super().__init__(message)
        self.status = status
        self.may_pass = may_pass


def viser_client() -> httpx.Client:
    """Return what fetches pages from the 3D servers: plain HTTP, no certificates, no proxy of the machine's."""
    # A kept connection may be closed by the other side just as it is used again, and a new one costs nothing here.
    unkept = httpx.Limits(max_keepalive_connections=0)
    return httpx.Client(trust_env=False, verify=False, timeout=ANSWER_TIMEOUT_S, limits=unkept)


@router.get("/{token}")
@needs("viewer")
def open_view(token: str, request: Request) -> Response:
    """Lead to the page's own folder, so that its relative addresses work."""
    return RedirectResponse(request.url.replace(path=f"{request.url.path}/"))


@router.get("/{token}/{path:path}")
@needs("viewer")
def fetch_view(token: str, path: str, request: Request, service: ServiceParts) -> Response:
    """Fetch one file of the 3D page."""
    try:
        port = find_port(service, token)
        return _fetch(service.viser, port, path, request)
    except NoView as error:
        return _sorry(request, error)


@router.websocket("/{token}/control")
@needs("viewer")
async def stream_control(token: str, socket: WebSocket, service: ServiceParts) -> None:
    """Connect our page with the session that it drives: commands in, states out, as JSON."""
    await _stream(token, socket, service, find_control_port)


@router.websocket("/{token}")
@router.websocket("/{token}/")
@needs("viewer")
async def stream_view(token: str, socket: WebSocket, service: ServiceParts) -> None:
    """Connect a 3D page with its server: whole messages, both ways, as they are."""
    await _stream(token, socket, service, find_port)


async def _stream(token: str, socket: WebSocket, service: Service, find_door: Callable[[Service, str], int]) -> None:
    try:
        port = await run_in_threadpool(find_door, service, token)
        server = await _connect(port, socket.scope.get("subprotocols", []))
    except NoView as error:
        await socket.send_denial_response(problem_answer(error.status, [problem(str(error))]))
        return
    async with server:
        await socket.accept(subprotocol=server.subprotocol)
        await _relay(socket, server, service, token)


def find_port(service: Service, token: str) -> int:
    """Return the port of the page that a token opens, and note that somebody watches it.

    Raises:
        NoView: it opens none.
    """
    port = _open(service, token).port
    assert port is not None
    return port


def find_control_port(service: Service, token: str) -> int:
    """Return the port at which the session that a token opens takes commands.

    Raises:
        NoView: it opens none.
    """
    port = _open(service, token).control_port
    if port is None:
        raise NoView(404, "This 3D view takes no commands; open it again from its run's page.")
    return port


def _open(service: Service, token: str) -> viewer_sessions.Session:
    """Return the ready session that a token opens, and note that somebody watches it."""
    try:
        session = viewer_sessions.get_session(service.database, service.tokens.read(token))
    except BadToken as error:
        raise NoView(403, str(error)) from error
    except NotFound as error:
        raise NoView(404, "This 3D view no longer exists; open it again from its run's page.") from error
    if session.state != "ready" or session.port is None:
        sentences = {
            "starting": "This 3D view is still starting.",
            "failed": f"This 3D view failed: {session.message or 'the viewer gave no reason'}",
        }
        ended = "This 3D view has ended; open it again from its run's page."
        raise NoView(404, sentences.get(session.state, ended), may_pass=session.state == "starting")
    viewer_sessions.touch(service.database, session.id)
    return session


def _fetch(viser: httpx.Client, port: int, path: str, request: Request) -> Response:
    headers = {name: value for name in FORWARDED_REQUEST_HEADERS if (value := request.headers.get(name))}
    headers.setdefault("accept-encoding", "identity")
    try:
        with viser.stream("GET", f"http://{VISER_HOST}:{port}/{quote(path)}", headers=headers) as answer:
            content = b"".join(answer.iter_raw())
    except httpx.HTTPError as error:
        raise _unreachable(port) from error
    kept = {name: value for name in FORWARDED_ANSWER_HEADERS if (value := answer.headers.get(name))}
    # The address is part of the key: it must not leak to other sites.
    kept |= {"Referrer-Policy": "no-referrer"}
    return Response(content, status_code=answer.status_code, headers=kept)


async def _connect(port: int, offered: list[str]) -> ClientConnection:
    try:
        return await connect(
            f"ws://{VISER_HOST}:{port}/",
            subprotocols=[Subprotocol(name) for name in offered] or None,
            compression=None,
            max_size=None,
            proxy=None,
            open_timeout=ANSWER_TIMEOUT_S,
        )
    except (OSError, TimeoutError, InvalidHandshake) as error:
        raise _unreachable(port) from error


async def _relay(socket: WebSocket, server: ClientConnection, service: Service, token: str) -> None:
    """Pass messages until either side ends or the session does; then end both."""
    directions = [
        asyncio.create_task(_pass_to_server(socket, server)),
        asyncio.create_task(_pass_to_page(server, socket)),
        asyncio.create_task(_stay_open(service, token, socket)),
    ]
    try:
        await asyncio.wait(directions, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in directions:
            task.cancel()
        outcomes = await asyncio.gather(*directions, return_exceptions=True)
    expected = (WebSocketDisconnect, ConnectionClosed, asyncio.CancelledError, NoView)
    for outcome in outcomes:
        if isinstance(outcome, Exception) and not isinstance(outcome, expected):
            log.error("a 3D view was cut off", exc_info=outcome)
    if not isinstance(outcomes[0], WebSocketDisconnect):
        code = server.close_code or 1000
        await socket.close(code if code not in (1005, 1006) else 1001, server.close_reason)


async def _pass_to_server(socket: WebSocket, server: ClientConnection) -> None:
    while True:
        message = await socket.receive()
        if message["type"] == "websocket.disconnect":
            raise WebSocketDisconnect(message.get("code", 1000))
        data = message.get("bytes")
        await server.send(data if data is not None else message["text"])


async def _pass_to_page(server: ClientConnection, socket: WebSocket) -> None:
    async for data in server:
        await (socket.send_text(data) if isinstance(data, str) else socket.send_bytes(data))


async def _stay_open(service: Service, token: str, socket: WebSocket) -> None:
    """End when the 3D session ended or its token expired, or when whoever watches is not signed in any more."""
    while True:
        await asyncio.sleep(TOUCH_INTERVAL_S)
        try:
            await run_in_threadpool(find_port, service, token)
            if isinstance(await run_in_threadpool(find_caller, service.access, service.database, socket), Refusal):
                return
        except StoreUnavailable as error:
            log.warning("%s The 3D view goes on.", error)


def _unreachable(port: int) -> NoView:
    log.warning("the 3D server on port %d does not answer", port)
    # Where trainings have all cores, it may take longer to begin than anybody waits for an answer.
    return NoView(502, "This 3D view does not answer just now; its machine may be busy.", may_pass=True)


def _sorry(request: Request, error: NoView) -> Response:
    """Answer a person with a small page, which looks again by itself if that may help, a program with `Problems`."""
    if "text/html" not in request.headers.get("accept", ""):
        return problem_answer(error.status, [problem(str(error))])
    page = (
        '<!doctype html><html lang="en"><meta charset="utf-8"><title>3D view</title>'
        '<meta name="color-scheme" content="light dark">'
        f'<body style="font: 1rem/1.5 system-ui; margin: 2rem"><p>{escape(str(error))}</p>'
    )
    again = {"Refresh": str(ASK_AGAIN_S)} if error.may_pass else {}
    return HTMLResponse(page, status_code=error.status, headers=again)
