"""The tasks: every number that tells one from another, as data.

A new task is one `TaskSpec` in a file of its family and, if its scene is new, one file in `sldr_core/envs/scenes`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, TypeVar, cast

from sldr_core.config.tasks.fetch import FETCH_PICK_AND_PLACE, FETCH_PUSH, FETCH_SLIDE
from sldr_core.config.tasks.hand import HAND_LOCOMOTION_TASKS, HAND_TASKS
from sldr_core.config.tasks.spec import (
    PHASES,
    FetchScene,
    HandScene,
    Hinge,
    Part,
    Phase,
    PoseGoal,
    PositionGoals,
    Scene,
    Shape,
    StackScene,
    TableScene,
    TaskSpec,
    TupleScene,
    Variant,
)
from sldr_core.config.tasks.stack import FETCH_STACK_2, FETCH_STACK_3
from sldr_core.config.tasks.tuple import FETCH_TUPLE_3, FETCH_TUPLE_5
from sldr_core.errors import UnknownName

__all__ = [
    "LOCOMOTION_TASKS",
    "PHASES",
    "TASKS",
    "FetchScene",
    "HandScene",
    "Hinge",
    "Part",
    "Phase",
    "PoseGoal",
    "PositionGoals",
    "Scene",
    "Shape",
    "StackScene",
    "TableScene",
    "TaskSpec",
    "TupleScene",
    "Variant",
    "explain_misfit",
    "find_task",
]

_Record = TypeVar("_Record", bound=Any)

TASKS: dict[str, TaskSpec] = {
    spec.name: spec
    for spec in (
        FETCH_PUSH,
        FETCH_SLIDE,
        FETCH_PICK_AND_PLACE,
        FETCH_STACK_2,
        FETCH_STACK_3,
        FETCH_TUPLE_3,
        FETCH_TUPLE_5,
        *HAND_TASKS,
    )
}
"""The tasks, in the paper's order."""

LOCOMOTION_TASKS: dict[str, TaskSpec] = {spec.name: spec for spec in HAND_LOCOMOTION_TASKS}
"""Further tasks that exist for locomotion only."""


def find_task(name: str, variant: Variant = "ours") -> TaskSpec:
    """Return the spec of a task, or of one that exists for locomotion only.

    Args:
        name: the task's name.
        variant: `original` has the numbers of the authors' code.

    Raises:
        UnknownName: no task is called `name`.
    """
    known = TASKS | LOCOMOTION_TASKS
    if name not in known:
        raise UnknownName("task", name, known)
    return known[name] if variant == "ours" else _lay_over(known[name], known[name].original)


def explain_misfit(spec: TaskSpec, phase: Phase) -> str | None:
    """Return why a task has no such phase, or None if it has."""
    if phase == "manipulation" and spec.name in LOCOMOTION_TASKS:
        return f"{spec.name} exists for locomotion only; the robot has no task of this name."
    if phase == "locomotion" and spec.name not in spec.locomotion_tasks:
        return f"the objects of {spec.name} learn in {' and '.join(spec.locomotion_tasks)}; choose that."
    return None


def _lay_over(record: _Record, changes: Mapping[str, Any]) -> _Record:
    """Return a copy of a record with `changes`; a mapping changes the record that it names."""
    values = {
        name: _lay_over(getattr(record, name), cast(Mapping[str, Any], value)) if isinstance(value, Mapping) else value
        for name, value in changes.items()
    }
    return replace(record, **values)
