"""Sparse rewards and success as pure functions of any batch shape, in the records of `sldr_core.config`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sldr_core.config import PoseGoal, PositionGoals
from sldr_core.envs.rotations import angle_between, angle_between_axes

Goals = NDArray[np.floating]


def goal_distance(criterion: PositionGoals, achieved: Goals, goal: Goals) -> NDArray[np.floating]:
    """Return the largest distance [m] of an object from its goal, or the joint norm, for goals `[..., G]`."""
    objects = 1 if criterion.joint_norm else criterion.objects
    apart = (achieved - goal).reshape(*np.shape(achieved)[:-1], objects, -1)
    return np.sqrt(np.square(apart).sum(axis=-1)).max(axis=-1)


def sparse_reward(criterion: PositionGoals | PoseGoal, achieved: Goals, goal: Goals) -> NDArray[np.float32]:
    """Return 0 where the goal is reached, else -1 (paper §3), for goals `[..., G]`.

    As in the reference, a position that is off by exactly the threshold is rewarded but no success.
    """
    if isinstance(criterion, PositionGoals):
        return -(goal_distance(criterion, achieved, goal) > criterion.distance).astype(np.float32)
    return is_success(criterion, achieved, goal).astype(np.float32) - np.float32(1.0)


def is_success(criterion: PositionGoals | PoseGoal, achieved: Goals, goal: Goals) -> NDArray[np.bool_]:
    """Tell where the goal is reached, for goals `[..., G]`."""
    if isinstance(criterion, PositionGoals):
        return goal_distance(criterion, achieved, goal) < criterion.distance
    reached = np.ones(np.shape(achieved)[:-1], dtype=np.bool_)
    if criterion.distance is not None:
        apart = achieved[..., :3] - goal[..., :3]
        reached &= np.sqrt(np.square(apart).sum(axis=-1)) < criterion.distance
    if criterion.angle is not None:
        angle = angle_between_axes if criterion.ignore_z else angle_between
        reached &= angle(achieved[..., 3:], goal[..., 3:]) < criterion.angle
    return reached
