"""How demonstrations ended: how many reached their goals, how soon, and which did not.

`N` demonstrations, `T` steps, `G` goal.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from sldr_core.config import TaskSpec
from sldr_core.demonstrations.collecting import Fan
from sldr_core.envs.rewards import Offsets, goal_offsets
from sldr_core.training.testing import wilson_interval

CONTROL_S = 0.04
"""Simulated time of one control step [s]."""

NEVER = -1
"""Stands for the step of what did not happen."""

Ending = Literal["missed", "left"]
"""How a demonstration failed: it never met its goal, or did and was elsewhere at the end."""


@dataclass(frozen=True)
class Summary:
    """Say how `episodes` demonstrations did."""

    episodes: int
    successes: int
    """Those at their goal at the end, as in every test."""
    low: float
    """Lower end of the success rate's 95 % Wilson interval."""
    high: float
    """Its upper end."""
    median_s: float | None
    """Median time to goal of the successful ones [s]."""


@dataclass(frozen=True)
class Failure:
    """Say which demonstration failed, and by how much."""

    index: int
    """Its place in the fan: counted on from the fan's first number, it gives start and goal again with the seed."""
    ending: Ending
    start: tuple[float, ...]
    """Achieved goal at the start, `[G]`."""
    goal: tuple[float, ...]
    """`[G]`."""
    gaps: dict[str, float]
    """How far from its goal it ended: `distance` [m], `angle` [rad], what the task scores."""


def steps_to_goal(reached: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Return the first moment from which on each demonstration was at its goal until the end, `[N]`.

    Args:
        reached: whether the goal was met at each moment, `[N, T+1]`.

    Returns:
        Moments from 0 to T; `NEVER` where the goal is not met at the end.
    """
    held = np.logical_and.accumulate(reached[:, ::-1], axis=1).sum(axis=1)
    return np.where(held > 0, reached.shape[1] - held, NEVER)


def summarise(reached: NDArray[np.bool_]) -> Summary:
    """Count successes among demonstrations that met their goals at `reached`, `[N, T+1]`, N at least 1."""
    arrival = steps_to_goal(reached)
    arrived = arrival[arrival != NEVER]
    low, high = wilson_interval(len(arrived), len(arrival))
    median = float(np.median(arrived)) * CONTROL_S if len(arrived) else None
    return Summary(len(arrival), len(arrived), low, high, median)


def list_failures(task: TaskSpec, fan: Fan, most: int) -> list[Failure]:
    """Return the failures of a fan, those that ended farthest from their goals first, at most so many."""
    failed = np.flatnonzero(~fan.reached[:, -1])
    if not failed.size:
        return []
    offsets = goal_offsets(task.goal, fan.achieved[failed, -1], fan.start.goal[failed])
    gaps = scored_gaps(task, offsets)
    return [
        _failure(fan, int(failed[place]), {name: float(values[place]) for name, values in gaps.items()})
        for place in np.argsort(-offsets.gap, kind="stable")[:most].tolist()
    ]


def scored_gaps(task: TaskSpec, offsets: Offsets) -> dict[str, NDArray[np.float64]]:
    """Return what of offsets the task scores: `distance` [m], `angle` [rad]."""
    named = {"distance": (task.success_distance, offsets.distance), "angle": (task.success_angle, offsets.angle)}
    return {name: values for name, (limit, values) in named.items() if limit is not None}


def _failure(fan: Fan, index: int, gaps: dict[str, float]) -> Failure:
    return Failure(
        index=index,
        ending="left" if fan.reached[index].any() else "missed",
        start=tuple(fan.achieved[index, 0].tolist()),
        goal=tuple(fan.start.goal[index].tolist()),
        gaps=gaps,
    )
