"""The one place where the API is put together."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from functools import cache
from importlib.metadata import version
from pathlib import Path

from fastapi import APIRouter, Depends, FastAPI
from fastapi.routing import APIRoute
from prometheus_client import CollectorRegistry
from starlette.middleware.body_limit import RequestBodyLimitMiddleware
from starlette.middleware.gzip import DEFAULT_EXCLUDED_CONTENT_TYPES, GZipMiddleware

from backend.api import viewer_proxy
from backend.api.access.callers import open_access
from backend.api.access.gate import Gate, check_access
from backend.api.access.headers import SafeHeaders
from backend.api.access.large_bodies import LargeBodies
from backend.api.access.passwords import Passwords
from backend.api.access.trail import Trail
from backend.api.dependencies import Service
from backend.api.errors import add_error_answers
from backend.api.hosts import LOCAL, HostRule, OwnHost
from backend.api.origins import SameOrigin
from backend.api.pages import BUILT_PAGE, add_pages
from backend.api.request_meter import RequestMeter, make_latencies
from backend.api.routes import (
    account,
    accounts,
    auth,
    choices,
    compare,
    compare_exports,
    episodes,
    health,
    labels,
    launches,
    media,
    monitoring,
    notices,
    queue,
    retention,
    run_actions,
    run_files,
    run_table,
    runs,
    saved_views,
    studies,
    study_files,
    viewer_sessions,
    workers,
)
from backend.api.shared_answers import SharedAnswers
from backend.api.tokens import ViewerTokens, load_secret
from backend.comparison.memory import ComparisonMemory
from backend.store.access.audit import forget_old_entries
from backend.store.access.entry import AccessMode
from backend.store.database import open_database
from backend.store.settings import Settings
from backend.store.storage import FileStorage
from backend.webhooks.sender import Sender

GZIP_LEVEL = 5
"""Nearly as small as the smallest, several times as fast."""

LARGEST_BODY = 1024 * 1024
"""Of a request; a route that takes more says so with `max_body_size` [bytes]."""

SMALLEST_GZIP = 1024
"""Shorter answers are sent as they are [bytes]."""

ROUTES = (
    health,
    monitoring,
    auth,
    account,
    accounts,
    choices,
    launches,
    studies,
    study_files,
    run_actions,
    labels,
    run_table,
    runs,
    run_files,
    episodes,
    media,
    queue,
    workers,
    saved_views,
    notices,
    retention,
    viewer_sessions,
    compare,
    compare_exports,
    viewer_proxy,
)
"""What the API answers, in the order in which addresses are compared."""


def create_app(
    settings: Settings,
    page: Path = BUILT_PAGE,
    hosts: HostRule = LOCAL,
    mode: AccessMode = "token",
    passwords: Passwords | None = None,
) -> FastAPI:
    """Return the API over one data directory and store; both are opened when it starts to serve.

    Args:
        settings: where files and tables lie.
        page: directory of the built page.
        hosts: the names that the server answers to.
        mode: how people come in.
        passwords: how passwords are kept; None: as they should be.
    """
    app = FastAPI(
        title="SLDR",
        summary="Train robot manipulation with sparse rewards.",
        version=version("sldr"),
        openapi_url="/api/openapi.json",
        docs_url=None,
        redoc_url=None,
        generate_unique_id_function=_operation_id,
        lifespan=_lifespan(settings, mode, passwords),
    )
    app.router.routes.extend(_guarded_routes().routes)
    add_pages(app, page)
    add_error_answers(app)
    _add_guards(app, hosts)
    return app


@cache
def _guarded_routes() -> APIRouter:
    """Put all routes behind the gate; applications of one process share them, as FastAPI takes long to prepare them."""
    guarded = APIRouter(generate_unique_id_function=_operation_id)
    for routes in ROUTES:
        guarded.include_router(routes.router, dependencies=[Depends(check_access)])
    return guarded


def _add_guards(app: FastAPI, hosts: HostRule) -> None:
    """Put around the routes what every request passes; the last one added is the first to be asked."""
    app.add_middleware(
        GZipMiddleware,
        minimum_size=SMALLEST_GZIP,
        compresslevel=GZIP_LEVEL,
        exclude_content_types=(*DEFAULT_EXCLUDED_CONTENT_TYPES, "application/octet-stream"),
    )
    app.add_middleware(SharedAnswers)
    app.add_middleware(Gate)
    app.add_middleware(SameOrigin)
    app.add_middleware(OwnHost, rule=hosts)
    app.add_middleware(RequestBodyLimitMiddleware, max_body_size=LARGEST_BODY)
    app.state.registry = CollectorRegistry()
    app.add_middleware(RequestMeter, latencies=make_latencies(app.state.registry))
    app.add_middleware(LargeBodies)
    app.add_middleware(Trail)
    app.add_middleware(SafeHeaders)


def _lifespan(settings: Settings, mode: AccessMode, passwords: Passwords | None):  # noqa: ANN202 - the decorator's type is longer than it helps
    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        database = open_database(settings)
        with viewer_proxy.viser_client() as viser:
            secret = load_secret(settings.secret_path)
            access = open_access(settings, secret, mode, passwords or Passwords())
            sender = Sender(database, settings.local_webhooks)
            app.state.service = Service(
                settings,
                database,
                FileStorage(settings),
                ViewerTokens(secret),
                viser,
                ComparisonMemory(),
                sender,
                access,
            )
            forget_old_entries(database)
            sender.start()
            yield
            sender.stop()
        database.close()

    return lifespan


def _operation_id(route: APIRoute) -> str:
    """Name operations like their functions, so that the generated client reads like the routes."""
    return route.name
