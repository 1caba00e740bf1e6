"""The one place where the API is put together."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from importlib.metadata import version
from pathlib import Path

from fastapi import FastAPI
from fastapi.routing import APIRoute
from starlette.middleware.gzip import DEFAULT_EXCLUDED_CONTENT_TYPES, GZipMiddleware

from backend.api import viewer_proxy
from backend.api.dependencies import Service
from backend.api.errors import add_error_answers
from backend.api.hosts import LOCAL, HostRule, OwnHost
from backend.api.origins import SameOrigin
from backend.api.pages import BUILT_PAGE, add_pages
from backend.api.routes import (
    choices,
    compare,
    compare_exports,
    episodes,
    health,
    labels,
    launches,
    media,
    queue,
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
from backend.api.tokens import ViewerTokens, load_secret
from backend.comparison.memory import ComparisonMemory
from backend.store.database import open_database
from backend.store.settings import Settings
from backend.store.storage import FileStorage

GZIP_LEVEL = 5
"""Nearly as small as the smallest, several times as fast."""

SMALLEST_GZIP = 1024
"""Shorter answers are sent as they are [bytes]."""


def create_app(settings: Settings, page: Path = BUILT_PAGE, hosts: HostRule = LOCAL) -> FastAPI:
    """Return the API over one data directory and store; both are opened when it starts to serve.

    Args:
        settings: where files and tables lie.
        page: directory of the built page.
        hosts: the names that the server answers to.
    """
    app = FastAPI(
        title="SLDR",
        summary="Train robot manipulation with sparse rewards.",
        version=version("sldr"),
        openapi_url="/api/openapi.json",
        docs_url=None,
        redoc_url=None,
        generate_unique_id_function=_operation_id,
        lifespan=_lifespan(settings),
    )
    for routes in (
        health,
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
        viewer_sessions,
        compare,
        compare_exports,
        viewer_proxy,
    ):
        app.include_router(routes.router)
    add_pages(app, page)
    add_error_answers(app)
    app.add_middleware(
        GZipMiddleware,
        minimum_size=SMALLEST_GZIP,
        compresslevel=GZIP_LEVEL,
        exclude_content_types=(*DEFAULT_EXCLUDED_CONTENT_TYPES, "application/octet-stream"),
    )
    app.add_middleware(SameOrigin)
    app.add_middleware(OwnHost, rule=hosts)
    return app


def _lifespan(settings: Settings):  # noqa: ANN202 - the decorator's type is longer than it helps
    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        database = open_database(settings)
        with viewer_proxy.viser_client() as viser:
            tokens = ViewerTokens(load_secret(settings.secret_path))
            app.state.service = Service(settings, database, FileStorage(settings), tokens, viser, ComparisonMemory())
            yield
        database.close()

    return lifespan


def _operation_id(route: APIRoute) -> str:
    """Name operations like their functions, so that the generated client reads like the routes."""
    return route.name
