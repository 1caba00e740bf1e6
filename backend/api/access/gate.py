"""The gate: nobody gets beyond it without being known, and no route answers to a role that it did not name.

Two locks, one behind the other. The gate looks at addresses, before anything of a request is read. `check_access`
looks at the route that was found, at what it declared with `needs`; one that declared nothing is refused.
"""

from __future__ import annotations

from fastapi import WebSocketException
from starlette.concurrency import run_in_threadpool
from starlette.datastructures import Headers
from starlette.requests import HTTPConnection
from starlette.responses import RedirectResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket

from backend.api.access.callers import TICKET_HOLDER, Caller, Refusal, find_caller
from backend.api.access.declarations import declaration_of
from backend.api.access.recent_callers import RecentCallers
from backend.api.errors import ApiError, problem, problem_answer
from backend.api.freshness import accepted_age
from backend.store.access.roles import allows
from backend.store.errors import StoreUnavailable

GUARDED = ("/api", "/viewer", "/metrics")
"""Nothing below these answers to nobody, whether there is a route or not."""

ENTRANCE = "/api/auth/enter"
"""Where the address that `sldr serve` prints leads."""

OPEN_PATHS = frozenset(
    {ENTRANCE, "/api/auth/me", "/api/auth/sign-in", "/api/auth/invitation", "/api/auth/invitation/accept"}
)
"""What is needed to sign in; a test holds it equal to the routes that are open to all."""

SHOW_HOW = {"WWW-Authenticate": 'Bearer realm="sldr"'}


class Gate:
    """Find out who asks; answer 401 to nobody."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on what may come in."""
        refusal = None if scope["type"] == "lifespan" else await _look(scope)
        if refusal is None:
            await self._app(scope, receive, send)
        elif scope["type"] == "websocket":
            await WebSocket(scope, receive, send).send_denial_response(refusal)
        else:
            await refusal(scope, receive, send)


async def check_access(connection: HTTPConnection) -> None:
    """Refuse whoever a route did not name.

    Raises:
        ApiError: 401 or 403.
        WebSocketException: the same for a websocket.
    """
    endpoint = connection.scope.get("endpoint")
    declared = declaration_of(endpoint)
    if declared is not None and declared.role is None:
        return
    found = await caller_or_refusal(connection)
    if isinstance(found, Refusal):
        raise _stop(connection, 401, found.message)
    if declared is None or declared.role is None:
        raise _stop(connection, 403, "This address does not say who may use it, so nobody may.")
    if not allows(found.role, declared.role):
        message = f"This needs the role {declared.role}; '{found.name}' may only do what a {found.role} may."
        raise _stop(connection, 403, message)


async def caller_or_refusal(connection: HTTPConnection) -> Caller | Refusal:
    """Return who asks, or why that is not known; looked up once for each request."""
    state = connection.scope.setdefault("state", {})
    if "caller" not in state:
        state["caller"] = await _find(connection)
    return state["caller"]


async def _find(connection: HTTPConnection) -> Caller | Refusal:
    service = connection.app.state.service
    recent: RecentCallers = service.access.recent
    at, writes = recent.now(), service.database.writes
    known = recent.find(connection, accepted_age(Headers(scope=connection.scope)), writes)
    if known is not None:
        return known
    found = await run_in_threadpool(find_caller, service.access, service.database, connection)
    # A ticket opens one address only, whatever else was shown with it.
    if isinstance(found, Caller) and found is not TICKET_HOLDER:
        recent.remember(connection, found, at, writes)
    return found


async def _look(scope: Scope) -> Response | None:
    connection = HTTPConnection(scope)
    path: str = scope["path"]
    if path == "/" and "token" in connection.query_params:
        return RedirectResponse(f"{ENTRANCE}?{connection.url.query}", 303)
    if not path.startswith(GUARDED):
        return None
    try:
        found = await caller_or_refusal(connection)
    except StoreUnavailable as error:
        return problem_answer(503, [problem(str(error))], {"Retry-After": "1"})
    if isinstance(found, Caller) or path in OPEN_PATHS:
        return None
    return problem_answer(401, [problem(found.message)], SHOW_HOW)


def _stop(connection: HTTPConnection, status: int, message: str) -> Exception:
    if connection.scope["type"] == "websocket":
        return WebSocketException(1008, message)
    return ApiError(status, message)
