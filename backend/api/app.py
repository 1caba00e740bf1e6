"""The one place where the API is put together."""

from __future__ import annotations

from importlib.metadata import version

from fastapi import FastAPI
from fastapi.routing import APIRoute

from backend.api.errors import add_error_answers
from backend.api.routes import choices, health, launches, run_files, runs, viewer_sessions, workers


def create_app() -> FastAPI:
    """Return the API over one data directory and store."""
    app = FastAPI(
        title="SLDR",
        summary="Train robot manipulation with sparse rewards.",
        version=version("sldr"),
        openapi_url="/api/openapi.json",
        docs_url=None,
        redoc_url=None,
        generate_unique_id_function=_operation_id,
    )
    for routes in (health, choices, launches, runs, run_files, workers, viewer_sessions):
        app.include_router(routes.router)
    add_error_answers(app)
    return app


def _operation_id(route: APIRoute) -> str:
    """Name operations like their functions, so that the generated client reads like the routes."""
    return route.name
