"""What a launch can choose from."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter
from fastapi.responses import FileResponse

from backend.api.errors import NotBuilt, problem_responses
from backend.api.schemas import Choices
from sldr_core.config import Phase

router = APIRouter(prefix="/api", tags=["choices"])


@router.get("/choices", responses=problem_responses())
def get_choices() -> Choices:
    """List tasks, phases, methods and presets, with the JSON schema of a config."""
    raise NotBuilt


@router.get(
    "/tasks/{task}/picture",
    response_class=FileResponse,
    responses={200: {"content": {"image/png": {}}}} | problem_responses(404, 422),
)
def get_task_picture(task: str) -> FileResponse:
    """Send the rendered picture of a task."""
    raise NotBuilt


@router.get("/defaults", responses=problem_responses(422))
def get_defaults(task: str, phase: Phase, method: str, preset: str) -> dict[str, Any]:
    """Return the whole config that a launch would use with seed 0 and no overrides."""
    raise NotBuilt
