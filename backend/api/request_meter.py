"""Counting and timing requests: for the monitor, and an id for each in the log and in the answer."""

from __future__ import annotations

import logging
import secrets
import time
from typing import Any

from prometheus_client import CollectorRegistry, Histogram
from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from backend.logs import about

METHODS = frozenset({"GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS"})
"""Methods with a label of their own; whoever asks could make up any number of others."""
OTHER = "other"
PAGE = "page"
"""The label of every address that no route names: the page and its files, and what does not exist."""
BUCKETS_S = (0.005, 0.01, 0.025, 0.05, 0.1, 0.2, 0.5, 1.0, 2.5, 10.0, 60.0)
"""Upper ends of the latencies that are told apart [s]."""
SLOW_S = 2.0
"""Requests that take longer are worth a line in the log [s]."""
REQUEST_HEADER = "x-request-id"

log = logging.getLogger("sldr.api.requests")


class RequestMeter:
    """Time every HTTP request, by method, route and kind of answer: labels that nobody can multiply."""

    def __init__(self, app: ASGIApp, latencies: Histogram) -> None:
        self._app = app
        self._latencies = latencies

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass the request on and note what came of it."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        request_id, begun, status = secrets.token_hex(6), time.perf_counter(), 500

        async def send_on(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
                MutableHeaders(scope=message)[REQUEST_HEADER] = request_id
            await send(message)

        with about(request_id=request_id):
            try:
                await self._app(scope, receive, send_on)
            finally:
                self._note(scope, status, time.perf_counter() - begun)

    def _note(self, scope: Scope, status: int, took_s: float) -> None:
        method = scope["method"] if scope["method"] in METHODS else OTHER
        route = route_label(scope)
        self._latencies.labels(method, route, f"{status // 100}xx").observe(took_s)
        level = logging.WARNING if status >= 500 or took_s > SLOW_S else logging.DEBUG
        log.log(level, "%s %s answered %d in %.3f s", method, route, status, took_s)


def make_latencies(registry: CollectorRegistry) -> Histogram:
    """Return the histogram of all requests."""
    return Histogram(
        "sldr_http_request_duration_seconds",
        "How long requests took, by method, route and kind of answer.",
        ("method", "route", "answer"),
        registry=registry,
        buckets=BUCKETS_S,
    )


def route_label(scope: Scope) -> str:
    """Return the pattern of the route that has answered, as in `/api/runs/{run_id}`."""
    route: Any = scope.get("route")
    path = getattr(route, "path", None)
    return path if isinstance(path, str) and path.startswith(("/api/", "/healthz", "/metrics", "/viewer/")) else PAGE
