"""What an agent's networks see: features of an observation and a goal, built when they are needed.

Building them from the goal at sample time means that a relabelled goal never leaves a stale feature behind.
`D` observation, `Z` object state, `G` goal, `F` features. Layouts are those of `sldr_core.envs.fetch`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import torch
from torch import Tensor

from sldr_core.config import Phase, TaskSpec

Features = Callable[[Tensor, Tensor], Tensor]
"""Return features `[..., F]` of observations `[..., D]` and goals `[..., G]`."""

OBJECT_STATE_SIZE = 12
"""Position 3, Euler angles 3, linear velocity 3, angular velocity 3."""


@dataclass(frozen=True)
class View:
    """A way of seeing, and how many features it gives."""

    size: int
    features: Features


def robot_features(obs: Tensor, goal: Tensor) -> Tensor:
    """Return the robot's observation with the goal behind it."""
    return torch.cat([obs, goal], dim=-1)


def object_features(state: Tensor, goal: Tensor) -> Tensor:
    """Return what the object sees (paper §5).

    Position, the way to the goal, rotation, velocity relative to the goal, spin, and the goal itself.
    """
    position, euler, linear, angular = state.split(3, dim=-1)
    return torch.cat([position, goal - position, euler, -linear, angular, goal], dim=-1)


def object_state(obs: Tensor) -> Tensor:
    """Return the object's own state `[..., 12]` out of the robot's observation `[..., 25]`."""
    position, euler, relative, angular, grip = (
        obs[..., 3:6],
        obs[..., 11:14],
        obs[..., 14:17],
        obs[..., 17:20],
        obs[..., 20:23],
    )
    return torch.cat([position, euler, relative + grip, angular], dim=-1)


def transition_features(state: Tensor, next_state: Tensor) -> Tensor:
    """Return what the inverse model sees of a transition: the state and how it changed, `[..., 2 Z]`."""
    return torch.cat([state, next_state - state], dim=-1)


def view_of(task: TaskSpec, phase: Phase) -> View:
    """Return how the one who acts in `phase` sees the task."""
    if phase == "locomotion":
        return View(OBJECT_STATE_SIZE + 2 * task.goal_size, object_features)
    return View(task.obs_size + task.goal_size, robot_features)
