"""Rewards, success and distances as pure functions of any batch shape, in the records of `sldr_core.config`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sldr_core.config import PoseGoal, PositionGoals, RewardKind
from sldr_core.envs.rotations import angle_between, angle_between_axes

Goals = NDArray[np.floating]

Criterion = PositionGoals | PoseGoal
"""What counts as success."""

RADIANS_PER_METRE = 10.0
"""Weight of a pose's distance against its angle in the dense reward, as in the reference [rad/m]."""

POSITION_SIZE = 3
"""Entries of a pose that are its position; a quaternion follows."""


def goal_distance(criterion: PositionGoals, achieved: Goals, goal: Goals) -> NDArray[np.floating]:
    """Return the largest distance [m] of an object from its goal, or the joint norm, for goals `[..., G]`."""
    objects = 1 if criterion.joint_norm else criterion.objects
    apart = (achieved - goal).reshape(*np.shape(achieved)[:-1], objects, -1)
    return _length(apart).max(axis=-1)


def sparse_reward(criterion: Criterion, achieved: Goals, goal: Goals) -> NDArray[np.float32]:
    """Return 0 where the goal is reached, else -1 (paper Eq. 1), for goals `[..., G]`.

    As in the reference, a position that is off by exactly the threshold is rewarded but no success.
    """
    if isinstance(criterion, PositionGoals):
        return -(goal_distance(criterion, achieved, goal) > criterion.distance).astype(np.float32)
    return is_success(criterion, achieved, goal).astype(np.float32) - np.float32(1.0)


def dense_reward(criterion: Criterion, achieved: Goals, goal: Goals) -> NDArray[np.float32]:
    """Return minus how far goals `[..., G]` are: one norm over all positions [m], or 10 per metre plus the angle.

    What a task does not score is left out of a pose, and angles are those of `is_success`.
    """
    if isinstance(criterion, PositionGoals):
        return -_length(achieved - goal).astype(np.float32)
    far = np.zeros(np.shape(achieved)[:-1])
    if criterion.distance is not None:
        far += RADIANS_PER_METRE * _pose_distance(achieved, goal)
    if criterion.angle is not None:
        far += _pose_angle(criterion, achieved, goal)
    return -far.astype(np.float32)


REWARDS: dict[RewardKind, Callable[[Criterion, Goals, Goals], NDArray[np.float32]]] = {
    "sparse": sparse_reward,
    "dense": dense_reward,
}
"""The environment's rewards by their names."""


def is_success(criterion: Criterion, achieved: Goals, goal: Goals) -> NDArray[np.bool_]:
    """Tell where the goal is reached, for goals `[..., G]`."""
    if isinstance(criterion, PositionGoals):
        return goal_distance(criterion, achieved, goal) < criterion.distance
    reached = np.ones(np.shape(achieved)[:-1], dtype=np.bool_)
    if criterion.distance is not None:
        reached &= _pose_distance(achieved, goal) < criterion.distance
    if criterion.angle is not None:
        reached &= _pose_angle(criterion, achieved, goal) < criterion.angle
    return reached


@dataclass(frozen=True)
class Offsets:
    """How far achieved goals are from desired ones, of any batch shape."""

    distance: NDArray[np.float64]
    """Largest distance of an object from its goal [m], or the joint norm where that is scored."""
    angle: NDArray[np.float64]
    """Angle between the rotations [rad]; NaN where goals have none."""
    gap: NDArray[np.float64]
    """The larger of those that are scored, in thresholds of success: it is reached below 1."""


def goal_offsets(criterion: Criterion, achieved: Goals, goal: Goals) -> Offsets:
    """Return how far goals `[..., G]` are, in units and in thresholds."""
    if isinstance(criterion, PositionGoals):
        distance = np.asarray(goal_distance(criterion, achieved, goal), dtype=np.float64)
        return Offsets(distance, np.full_like(distance, np.nan), distance / criterion.distance)
    distance = np.asarray(_pose_distance(achieved, goal), dtype=np.float64)
    angle = np.asarray(_pose_angle(criterion, achieved, goal), dtype=np.float64)
    gap = np.zeros_like(distance)
    if criterion.distance is not None:
        gap = np.maximum(gap, distance / criterion.distance)
    if criterion.angle is not None:
        gap = np.maximum(gap, angle / criterion.angle)
    return Offsets(distance, angle, gap)


def remaining_distance(criterion: Criterion, achieved: Goals, goal: Goals) -> NDArray[np.floating]:
    """Return how far goals `[..., G]` are in one number: one norm over all positions [m], or over what a pose scores.

    A turn counts in it as the nearer of its quaternion's two signs is away: 2 sin(angle / 4).
    """
    if isinstance(criterion, PositionGoals):
        return np.linalg.norm(achieved - goal, axis=-1)
    squared = np.zeros(np.shape(achieved)[:-1])
    if criterion.distance is not None:
        squared += np.square(_pose_distance(achieved, goal))
    if criterion.angle is not None:
        squared += np.square(2.0 * np.sin(_pose_angle(criterion, achieved, goal) / 4.0))
    return np.sqrt(squared)


def object_positions(criterion: Criterion, achieved: Goals) -> NDArray[np.floating]:
    """Return the positions of the objects [m], `[..., O, 3]`, in achieved goals `[..., G]`."""
    if isinstance(criterion, PositionGoals):
        return achieved.reshape(*achieved.shape[:-1], -1, POSITION_SIZE)
    return achieved[..., None, :POSITION_SIZE]


def goal_gaps(criterion: Criterion, goals: Goals, others: Goals) -> NDArray[np.float64]:
    """Return Euclidean distances `[..., M, N]` of goals `[..., M, G]` from others `[..., N, G]`.

    Of a pose only what is scored counts, and a quaternion is as near as the nearer of its two signs.
    """
    a, b = (np.asarray(values, dtype=np.float64) for values in (goals, others))
    if isinstance(criterion, PositionGoals):
        return np.sqrt(_squared_gaps(a, b, signless=False))
    squared = np.zeros((*a.shape[:-1], b.shape[-2]))
    if criterion.distance is not None:
        squared += _squared_gaps(a[..., :POSITION_SIZE], b[..., :POSITION_SIZE], signless=False)
    if criterion.angle is not None:
        squared += _squared_gaps(a[..., POSITION_SIZE:], b[..., POSITION_SIZE:], signless=True)
    return np.sqrt(squared)


def _length(vectors: Goals) -> NDArray[np.floating]:
    return np.sqrt(np.square(vectors).sum(axis=-1))


def _pose_distance(achieved: Goals, goal: Goals) -> NDArray[np.floating]:
    return _length(achieved[..., :POSITION_SIZE] - goal[..., :POSITION_SIZE])


def _pose_angle(criterion: PoseGoal, achieved: Goals, goal: Goals) -> NDArray[np.floating]:
    angle = angle_between_axes if criterion.ignore_z else angle_between
    return angle(achieved[..., POSITION_SIZE:], goal[..., POSITION_SIZE:])


def _squared_gaps(a: NDArray[np.float64], b: NDArray[np.float64], signless: bool) -> NDArray[np.float64]:
    """Return |a - b|^2 of all pairs through their products; with `signless`, the lesser of |a - b|^2 and |a + b|^2."""
    product = a @ np.swapaxes(b, -1, -2)
    if signless:
        product = np.abs(product)
    sizes = np.square(a).sum(axis=-1)[..., :, None] + np.square(b).sum(axis=-1)[..., None, :]
    return np.maximum(sizes - 2.0 * product, 0.0)
