"""Sparse rewards and success of position goals, as pure functions of any batch shape."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def goal_distance(achieved: NDArray[np.floating], goal: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return the Euclidean distance [m] between achieved and desired goals `[..., G]`, as `[...]`."""
    return np.sqrt(np.square(achieved - goal).sum(axis=-1))


def sparse_reward(achieved: NDArray[np.floating], goal: NDArray[np.floating], threshold: float) -> NDArray[np.float32]:
    """Return 0 where the goal is within `threshold` [m], else -1 (paper §3), for goals `[..., G]`."""
    return -(goal_distance(achieved, goal) > threshold).astype(np.float32)


def is_success(achieved: NDArray[np.floating], goal: NDArray[np.floating], threshold: float) -> NDArray[np.bool_]:
    """Tell where the goal is nearer than `threshold` [m], for goals `[..., G]`."""
    return goal_distance(achieved, goal) < threshold
