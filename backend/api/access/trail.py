"""The audit trail: every change that somebody made or was refused goes into the audit log, with who and from where."""

from __future__ import annotations

import logging
import threading
import time
from collections import OrderedDict
from collections.abc import Callable

from starlette.concurrency import run_in_threadpool
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from backend.api.access.callers import Caller
from backend.api.access.declarations import declaration_of
from backend.redaction import redact
from backend.store.access.audit import Deed, Outcome, write_entry
from backend.store.access.entry import NOBODY
from backend.store.database import Database
from backend.store.errors import StoreUnavailable

log = logging.getLogger("sldr.audit")

REFUSED = frozenset({401, 403, 413, 429})
"""Answers that say that something was not allowed."""

CLOSED_UNOPENED = 403
"""How a websocket that is closed before it was accepted looks to a browser."""

ONCE_PER_S = 60.0
"""The same refusal of the same caller is written once in this time [s]."""

MOST_PER_WINDOW = 300
"""Refusals written in that time, so that nobody fills the disk with them."""

HARMLESS_METHODS = frozenset({"GET", "HEAD", "OPTIONS"})


class Trail:
    """Write down what was changed and what was refused."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app
        self._told = RecentlyTold()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer as the app does; what belongs into the log is there before the answer is sent."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        is_open = False

        async def write_first(message: Message) -> None:
            nonlocal is_open
            status = _status_of(message, is_open)
            is_open = is_open or message["type"] == "websocket.accept"
            if status is not None:
                await self._write(scope, status)
            await send(message)

        await self._app(scope, receive, write_first)

    async def _write(self, scope: Scope, status: int) -> None:
        deed = describe(scope, status)
        if deed is not None and (deed.outcome != "refused" or self._told.is_news(deed)):
            await run_in_threadpool(record, scope["app"].state.service.database, deed)


def _status_of(message: Message, is_open: bool) -> int | None:
    """Return the status with which a request is answered, if this message is its answer's beginning."""
    if message["type"] in ("http.response.start", "websocket.http.response.start"):
        return message["status"]
    if message["type"] == "websocket.close" and not is_open:
        return CLOSED_UNOPENED
    return None


class RecentlyTold:
    """Remember refusals for a while, to tell each once."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._told: OrderedDict[tuple[str, ...], float] = OrderedDict()
        self._lock = threading.Lock()

    def is_news(self, deed: Deed) -> bool:
        """Tell whether a refusal was not told lately, and that there is room for it."""
        key = (deed.who, deed.address, deed.action, deed.target or "", deed.detail or "")
        now = self._clock()
        with self._lock:
            while self._told and now - next(iter(self._told.values())) >= ONCE_PER_S:
                self._told.popitem(last=False)
            if key in self._told or len(self._told) >= MOST_PER_WINDOW:
                return False
            self._told[key] = now
        return True


def describe(scope: Scope, status: int) -> Deed | None:
    """Return what a request did, for the audit log, or None if it does not belong there."""
    found = scope.get("state", {}).get("caller")
    who = found.name if isinstance(found, Caller) else NOBODY
    method = scope.get("method", "websocket")
    endpoint = scope.get("endpoint")
    declared = declaration_of(endpoint)
    is_change = method not in HARMLESS_METHODS and method != "websocket"
    outcome: Outcome
    if status in REFUSED or _leads_out(scope):
        outcome = "refused"
    elif is_change and declared is not None and declared.is_audited and (status < 400 or status >= 500):
        outcome = "done" if status < 400 else "failed"
    else:
        return None
    name = getattr(endpoint, "__name__", None)
    action = name.replace("_", " ") if name and declared is not None else method
    return Deed(who, action, client_address(scope), outcome, redact(scope["path"]), f"{method}, answered {status}")


def record(db: Database, deed: Deed) -> None:
    """Write an entry into the audit log and a line into the process's own; a store that is away stops nothing."""
    log.info("%s: %s of %s from %s, %s", deed.outcome, deed.action, deed.who, deed.address, deed.target)
    try:
        write_entry(db, deed)
    except StoreUnavailable as error:
        log.warning("An entry of the audit log was lost (%s of %s, %s): %s", deed.action, deed.who, deed.outcome, error)


def client_address(scope: Scope) -> str:
    """Return where a request comes from."""
    client = scope.get("client")
    return client[0] if client else "unknown"


def _leads_out(scope: Scope) -> bool:
    """Tell whether a path tries to leave its directory."""
    return ".." in scope["path"].replace("\\", "/").split("/")
