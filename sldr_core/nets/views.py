"""What an agent's networks see: features of an observation and a goal, built when they are needed.

Building them from the goal at sample time means that a relabelled goal never leaves a stale feature behind.
`D` observation, `Z` object state, `G` goal, `F` features. Layouts are those of the
observers in `sldr_core.envs`; `n` objects.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import torch
from torch import Tensor

from sldr_core.config import Part, Phase, PoseGoal, TaskSpec

Features = Callable[[Tensor, Tensor], Tensor]
"""Return features `[..., F]` of observations `[..., D]` and goals `[..., G]`."""

POSITION_SIZE = 3
"""Entries of a position, of Euler angles, of a velocity."""

QUATERNION_SIZE = 4
"""Entries of a rotation."""

POSE_SIZE = POSITION_SIZE + QUATERNION_SIZE
"""Entries of an object's pose, the last ones of what the hand or its object sees."""

HAND_ROBOT_SIZE = 48
"""Entries of the hand's own joints, before the object's in an observation: 24 positions, 24 velocities."""


@dataclass(frozen=True)
class View:
    """A way of seeing, and how many features it gives."""

    size: int
    features: Features


@dataclass(frozen=True)
class PartView:
    """What the locomotion model of a part is given of the robot's observation and goal."""

    object_state: Callable[[Tensor], Tensor]
    """Return the part's own state `[..., Z]` out of the robot's observation `[..., D]`."""
    part_goal: Callable[[Tensor], Tensor]
    """Return the part's own goal out of the robot's goal `[..., G]`."""


def joined_features(obs: Tensor, goal: Tensor) -> Tensor:
    """Return what is seen with the goal behind it."""
    return torch.cat([obs, goal], dim=-1)


def nearest_features(obs: Tensor, goal: Tensor, criterion: PoseGoal) -> Tensor:
    """Return what is seen, the object's pose last, and behind it, of all poses that count as the goal, the nearest.

    A pen's roll is left as it is wanted, also where it does not count: the nearest roll was learnt no better.

    Args:
        obs: what is seen.
        goal: the wanted pose: position and quaternion.
        criterion: what of a pose counts.
    """
    position, rotation = obs[..., -POSE_SIZE:].split((POSITION_SIZE, QUATERNION_SIZE), dim=-1)
    if criterion.distance is not None:
        position = goal[..., :POSITION_SIZE]
    if criterion.angle is not None:
        rotation = nearest_sign(goal[..., POSITION_SIZE:], rotation)
    return torch.cat([obs, position, rotation], dim=-1)


def nearest_sign(wanted: Tensor, seen: Tensor) -> Tensor:
    """Return quaternions `[..., 4]` with the sign that is nearer to those seen: either is the same rotation."""
    is_opposite = (wanted * seen).sum(dim=-1, keepdim=True) < 0.0
    return torch.where(is_opposite, -wanted, wanted)


def object_features(state: Tensor, goal: Tensor) -> Tensor:
    """Return what objects on a table see (paper §5).

    Positions, the ways to the goals, rotations, velocities relative to the goals, spins, and the goals themselves.
    """
    position, euler, linear, angular = state.chunk(4, dim=-1)
    return torch.cat([position, goal - position, euler, -linear, angular, goal], dim=-1)


def table_state(obs: Tensor, objects: int, chosen: range) -> Tensor:
    """Return the states of `chosen` objects `[..., 12 len(chosen)]` out of the Fetch robot's observation of n."""
    each = 3 * objects
    _, position, _, _, euler, relative, angular, grip, _ = obs.split((3, each, each, 2, each, each, each, 3, 2), dim=-1)
    linear = relative + torch.cat([grip] * objects, dim=-1)
    return torch.cat([_choose(values, chosen) for values in (position, euler, linear, angular)], dim=-1)


def hand_state(obs: Tensor) -> Tensor:
    """Return the object's state `[..., 13]` out of the hand's observation: velocities 6, pose 7."""
    return obs[..., HAND_ROBOT_SIZE:]


def transition_features(state: Tensor, next_state: Tensor) -> Tensor:
    """Return what the inverse model sees of a transition: the state and how it changed, `[..., 2 Z]`."""
    return torch.cat([state, next_state - state], dim=-1)


def view_of(task: TaskSpec, phase: Phase) -> View:
    """Return how the one who acts in `phase` sees the task."""
    if phase == "locomotion" and task.family != "hand":
        return View(task.object_state_size + 2 * task.goal_size, object_features)
    features = joined_features
    if isinstance(task.goal, PoseGoal) and task.goal.seen_nearest:
        features = partial(nearest_features, criterion=task.goal)
    size = task.obs_size if phase == "manipulation" else task.object_state_size
    return View(size + task.goal_size, features)


def part_view(task: TaskSpec, part: Part) -> PartView:
    """Return what of the robot's observation and goal is the part's: all of it, or one object of a stack."""
    if task.family == "hand":
        return PartView(hand_state, _whole)
    objects = task.goal_size // POSITION_SIZE
    index = part.object_index
    chosen = range(index, index + 1) if task.family == "stack" else range(objects)
    return PartView(lambda obs: table_state(obs, objects, chosen), lambda goal: _choose(goal, chosen))


def _choose(values: Tensor, chosen: range) -> Tensor:
    """Return the entries of `chosen` objects, three for each."""
    return values[..., POSITION_SIZE * chosen.start : POSITION_SIZE * chosen.stop]


def _whole(goal: Tensor) -> Tensor:
    return goal
