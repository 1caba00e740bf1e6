"""Errors as answers: every 4xx and 5xx body is `Problems`, and no traceback leaves the server."""

from __future__ import annotations

import logging
import secrets
from collections.abc import Sequence
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import Response
from starlette.exceptions import HTTPException

from backend.api.schemas import Problem, Problems
from backend.store.errors import FileGone, NotFound, Refused, StoreUnavailable, WrongState
from sldr_core.errors import InvalidConfig, SldrError, UnknownName

log = logging.getLogger("sldr.api")

DESCRIPTIONS = {
    400: "The request cannot be read.",
    401: "Nobody is signed in.",
    403: "Not allowed.",
    404: "It does not exist.",
    409: "Its state does not allow this.",
    413: "The request is too large.",
    416: "The range lies outside the file.",
    422: "A field or setting cannot work.",
    429: "Too many attempts.",
    500: "An error of the service itself.",
    503: "The store cannot be used just now.",
}

OF_ALL = (401, 403, 413, 500, 503)
"""What every route may answer with."""


class ApiError(Exception):
    """Stop a request with a status and one sentence, naming the field at fault if there is one."""

    def __init__(self, status: int, message: str, field: str | None = None) -> None:
        super().__init__(message)
        self.status = status
        self.field = field


def problem_responses(*codes: int) -> dict[int | str, dict[str, Any]]:
    """Return the schema's entries for the errors that a route can answer with."""
    return {code: {"model": Problems, "description": DESCRIPTIONS[code]} for code in (*codes, *OF_ALL)}


def problem_answer(status: int, problems: Sequence[Problem], headers: dict[str, str] | None = None) -> Response:
    """Return an error answer with its body."""
    body = Problems(problems=list(problems)).model_dump_json()
    return Response(body, status_code=status, headers=headers, media_type="application/json")


def problem(message: str, field: str | None = None) -> Problem:
    """Return one problem; what a request smuggled into its words is made printable."""
    return Problem(field=None if field is None else _printable(field), message=_printable(message))


def add_error_answers(app: FastAPI) -> None:
    """Turn every error, expected or not, into an answer with `Problems`."""
    app.add_exception_handler(ApiError, _answer_api_error)
    app.add_exception_handler(RequestValidationError, _answer_invalid_request)
    app.add_exception_handler(HTTPException, _answer_http_error)
    app.add_exception_handler(SldrError, _answer_sldr_error)
    app.add_exception_handler(StoreUnavailable, _answer_unavailable_store)
    app.add_exception_handler(Exception, _answer_unexpected_error)


def _answer_api_error(request: Request, error: Exception) -> Response:
    assert isinstance(error, ApiError)
    return problem_answer(error.status, [problem(str(error), error.field)])


def _answer_invalid_request(request: Request, error: Exception) -> Response:
    assert isinstance(error, RequestValidationError)
    return problem_answer(422, [_request_problem(part) for part in error.errors()])


def _answer_http_error(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    path = request.url.path
    sentences = {
        400: "The request's body cannot be read; send JSON as UTF-8.",
        404: f"There is nothing at {path}.",
        405: f"{request.method} is not possible on {path}.",
        413: "The request is larger than this address takes.",
    }
    message = sentences.get(error.status_code, str(error.detail))
    return problem_answer(error.status_code, [problem(message)], dict(error.headers or {}))


def _answer_sldr_error(request: Request, error: Exception) -> Response:
    if isinstance(error, InvalidConfig):
        return problem_answer(422, [problem(text, name) for name, text in error.problems.items()])
    if isinstance(error, UnknownName):
        return problem_answer(422, [problem(str(error), error.kind)])
    status = 404 if isinstance(error, NotFound | FileGone) else 409 if isinstance(error, WrongState | Refused) else 422
    return problem_answer(status, [problem(str(error))])


def _answer_unavailable_store(request: Request, error: Exception) -> Response:
    log.error("%s in %s %s", error, request.method, request.url.path)
    return problem_answer(503, [problem(str(error))], {"Retry-After": "1"})


def _answer_unexpected_error(request: Request, error: Exception) -> Response:
    """Say where to look; the traceback goes to the log, under the same mark."""
    mark = secrets.token_hex(4)
    log.error("error %s in %s %s", mark, request.method, request.url.path, exc_info=error)
    message = f"The service failed to answer. Its log holds the cause under the mark {mark}."
    return problem_answer(500, [problem(message)])


def _request_problem(error: dict[str, Any]) -> Problem:
    """Return one finding of the request's validation, without the part of the request it stood in."""
    if error["type"] == "json_invalid":
        return problem(f"The body is not JSON: {error['ctx']['error']}.")
    field = ".".join(str(part) for part in error["loc"][1:]) or None
    if error["type"] == "extra_forbidden":
        return problem("There is no such field; leave it out.", field)
    if error["type"] == "missing":
        return problem("This is missing; give a value.", field)
    return problem(f"{error['msg']} (got {_shortened(error['input'])}).", field)


def _shortened(value: Any, longest: int = 80) -> str:
    text = repr(value)
    return text if len(text) <= longest else f"{text[:longest]}..."


def _printable(text: str) -> str:
    return text.encode(errors="backslashreplace").decode()
