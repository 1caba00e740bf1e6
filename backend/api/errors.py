"""Errors as answers: every 4xx and 5xx body is `Problems`."""

from __future__ import annotations

from typing import Any

from fastapi import FastAPI, Request
from fastapi.responses import JSONResponse

from backend.api.schemas import Problem, Problems

DESCRIPTIONS = {
    403: "Not allowed.",
    404: "It does not exist.",
    409: "Its state does not allow this.",
    416: "The range lies outside the file.",
    422: "A field or setting cannot work.",
    500: "An error of the service itself.",
}


class NotBuilt(Exception):
    """Stand for a route that cannot answer yet."""


def problem_responses(*codes: int) -> dict[int | str, dict[str, Any]]:
    """Return the schema's entries for the errors that a route can answer with."""
    return {code: {"model": Problems, "description": DESCRIPTIONS[code]} for code in (*codes, 500)}


def add_error_answers(app: FastAPI) -> None:
    """Turn every error into an answer with `Problems`."""
    app.add_exception_handler(NotBuilt, _answer_not_built)


def _answer_not_built(request: Request, error: Exception) -> JSONResponse:
    problems = Problems(problems=[Problem(field=None, message="This route is not built yet.")])
    return JSONResponse(problems.model_dump(), status_code=501)
