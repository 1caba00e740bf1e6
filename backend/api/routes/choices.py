"""What a launch can choose from."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from fastapi import APIRouter
from fastapi.responses import FileResponse

from backend.api.access.declarations import needs
from backend.api.dependencies import ServiceSettings
from backend.api.errors import ApiError, problem_responses
from backend.api.schemas import Choices, Method, PresetSummary, Task
from backend.api.small_pictures import small_form
from backend.store.settings import Settings
from sldr_core.config import METHODS, PHASES, TASKS, Phase, TaskSpec, config_schema, config_to_dict
from sldr_core.errors import UnknownName
from sldr_core.presets import PRESETS, make_config

router = APIRouter(prefix="/api", tags=["choices"])


@router.get("/choices", responses=problem_responses())
@needs("viewer")
def get_choices() -> Choices:
    """List tasks, phases, methods and presets, with the JSON schema of a config."""
    return Choices(
        tasks=[_task(spec) for spec in TASKS.values()],
        phases=list(PHASES),
        methods=[
            Method(
                name=spec.name,
                title=spec.title,
                summary=spec.summary,
                needs_locomotion=spec.needs_locomotion,
                phases=list(spec.phases),
            )
            for spec in METHODS.values()
        ],
        presets=[PresetSummary(name=preset.name, summary=preset.summary) for preset in PRESETS.values()],
        config_schema=config_schema(),
    )


@router.get(
    "/tasks/{task}/picture",
    response_class=FileResponse,
    responses={200: {"content": {"image/png": {}}}} | problem_responses(404, 422),
)
@needs("viewer")
def get_task_picture(task: str, settings: ServiceSettings) -> FileResponse:
    """Send the rendered picture of a task."""
    return FileResponse(_find_picture(task, settings), media_type="image/png")


@router.get("/tasks/{task}/thumbnail", include_in_schema=False)
@needs("viewer")
def get_task_thumbnail(task: str, settings: ServiceSettings) -> FileResponse:
    """Send a small form of a task's picture, where the thumbnail of a run that has none leads."""
    return FileResponse(small_form(_find_picture(task, settings)))


@router.get("/defaults", responses=problem_responses(422))
@needs("viewer")
def get_defaults(task: str, phase: Phase, method: str, preset: str) -> dict[str, Any]:
    """Return the whole config that a launch would use with seed 0 and no overrides."""
    return config_to_dict(make_config(task, phase, method, 0, preset))


def _task(spec: TaskSpec) -> Task:
    return Task(
        name=spec.name,
        goal_text=spec.goal_text,
        obs_size=spec.obs_size,
        goal_size=spec.goal_size,
        robot_action_size=spec.robot_action_size,
        object_action_size=spec.object_action_size,
        episode_length=spec.episode_length,
        success_distance=spec.success_distance,
        success_angle=spec.success_angle,
        picture_url=f"/api/tasks/{spec.name}/picture",
    )


def _find_picture(task: str, settings: Settings) -> Path:
    """Return where the picture of a task lies.

    Raises:
        ApiError: there is no such task, or it is not drawn yet.
    """
    if task not in TASKS:
        raise ApiError(404, str(UnknownName("task", task, TASKS)), "task")
    path = settings.pictures_directory / f"{task}.png"
    if not path.is_file():
        raise ApiError(404, f"The picture of {task} is not drawn yet; the viewer draws it when it starts.")
    return path
