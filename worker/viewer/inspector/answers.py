"""What the inspector tells the page, as plain values for JSON: maps, failures, timelines, slices."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from sldr_core.config import TupleScene
from sldr_core.demonstrations import (
    BLOCK,
    MOST,
    Axis,
    Landscape,
    Space,
    cover,
    list_failures,
    steps_to_goal,
    summarise,
)
from sldr_core.demonstrations.landscape import values_of
from sldr_core.demonstrations.outcomes import scored_gaps
from sldr_core.demonstrations.slices import AXES, TITLES
from sldr_core.envs.rewards import goal_offsets
from worker.viewer.inspector.colours import SCALE
from worker.viewer.inspector.inspection import Inspection

MOST_FAILURES = 100
"""Failures that are listed at most."""

DIGITS = 4
"""Values of Q are told with so many decimals: a page draws them."""

Answer = dict[str, Any]


def tell_about(inspection: Inspection) -> Answer:
    """Return what can be chosen."""
    inspected, task = inspection.inspected, inspection.inspected.task
    scene = task.scene
    return {
        "task": task.name,
        "start_tasks": list(inspected.start_tasks),
        "objects": _objects(inspection),
        "bodies": task.object_action_size // 7,
        "shapes": [shape.name for shape in scene.shapes] if isinstance(scene, TupleScene) else [],
        "spaces": [{"name": space.name, "title": space.title} for space in inspection.spaces],
        "slices": [
            {"kind": kind, "title": TITLES[kind], "planes": [[AXES[axis] for axis in plane] for plane in planes]}
            for kind, planes in inspection.slices.planes.items()
        ],
        "can_place": inspection.source.group == 1,
        "block": BLOCK,
        "most": MOST,
        "success_rate": inspected.model.measured.success_rate,
        "test_episodes": inspected.model.measured.episodes,
        "scale": SCALE.tolist(),
    }


def tell_fan(inspection: Inspection) -> Answer | None:
    """Return how the fan stands, None before the first; small, it is told with every frame."""
    fan, collecting = inspection.fan, inspection.collecting
    if fan is None and collecting is None:
        return None
    done = 0 if fan is None else fan.count
    summary = None if fan is None else summarise(fan.reached)
    return {
        "seed": inspection.seed,
        "done": done,
        "count": done if collecting is None else collecting.count,
        "collecting": collecting is not None,
        "version": inspection.fan_version,
        "successes": summary and summary.successes,
        "low": summary and summary.low,
        "high": summary and summary.high,
        "median_s": summary and summary.median_s,
    }


def tell_map(inspection: Inspection, space: Space) -> Answer:
    """Return success and time to goal over a space; None stands where no demonstration was successful."""
    fan = inspection.fan
    axes = {"x": _axis(space.x), "y": _axis(space.y), "layer": _axis(space.layer)}
    answer = {"space": space.name, "title": space.title, "version": inspection.fan_version, **axes}
    if fan is None:
        return {**answer, "episodes": [], "successes": [], "median_s": []}
    covered = cover(space, fan.start, np.arange(fan.count), steps_to_goal(fan.reached))
    return {
        **answer,
        "episodes": covered.episodes.tolist(),
        "successes": covered.successes.tolist(),
        "median_s": _without_nan(covered.median_s),
    }


def tell_failures(inspection: Inspection) -> Answer:
    """Return the fan's failures, the worst first."""
    fan, group = inspection.fan, inspection.source.group
    if fan is None:
        return {"version": inspection.fan_version, "total": 0, "failures": []}
    objects = _objects(inspection)
    failures = list_failures(inspection.inspected.task, fan, MOST_FAILURES)
    return {
        "version": inspection.fan_version,
        "total": int((~fan.reached[:, -1]).sum()),
        "failures": [
            {
                "number": failure.index // group,
                "object": objects[failure.index % group],
                "ending": failure.ending,
                "gaps": failure.gaps,
                "start": failure.start,
                "goal": failure.goal,
            }
            for failure in failures
        ],
    }


def tell_timeline(inspection: Inspection) -> Answer:
    """Return the curves of the demonstration, by `group/name`, as other views do: Q(z, u, g) and the gaps to goals."""
    shown, nets, task = inspection.demonstration, inspection.inspected.model.nets, inspection.inspected.task
    names = _objects(inspection)
    columns: dict[str, list[float]] = {}
    for part, name in enumerate(names):
        goal, of = shown.start.goal[part], f" of {name}" if len(names) > 1 else ""
        value = values_of(nets, shown.state[part, :-1], goal[None], shown.action[part])
        columns[f"value/Q of what it does{of}"] = value.tolist()
        gaps = scored_gaps(task, goal_offsets(task.goal, shown.achieved[part], goal[None]))
        columns |= {f"{group}/goal{of}": values.tolist() for group, values in gaps.items()}
    return {"version": inspection.version, "known": shown.steps, "steps": shown.steps, "columns": columns}


def tell_slice(landscape: Landscape, version: int) -> Answer:
    """Return a slice of Q."""
    plane = landscape.slice
    across, up = plane.grid()
    return {
        "version": version,
        "kind": plane.kind,
        "title": TITLES[plane.kind],
        "axes": [AXES[axis] for axis in plane.axes],
        "unit": {"turn": "rad", "action": ""}.get(plane.kind, "m"),
        "across": across.round(DIGITS).tolist(),
        "up": up.round(DIGITS).tolist(),
        "value": landscape.value.astype(np.float64).round(DIGITS).tolist(),
        "here": landscape.here,
        "now": landscape.now,
    }


def _objects(inspection: Inspection) -> list[str]:
    """Return what the objects that act side by side are called."""
    group = inspection.source.group
    return [f"block {index + 1}" for index in range(group)] if group > 1 else ["object"]


def _axis(axis: Axis) -> Answer:
    return {"name": axis.name, "unit": axis.unit, "edges": axis.edges, "names": axis.names}


def _without_nan(values: NDArray[np.float64]) -> list[Any]:
    plain = values.astype(object)
    plain[np.isnan(values)] = None
    return plain.tolist()
