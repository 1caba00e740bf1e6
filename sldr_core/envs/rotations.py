"""Rotations in batches, in the conventions of gymnasium-robotics."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_GIMBAL_EPS = 4 * np.finfo(np.float64).eps


def euler_from_matrix(matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the angles x, y, z [rad] of rotation matrices.

    Args:
        matrix: `[..., 3, 3]`.

    Returns:
        `[..., 3]`; x is 0 where the rotation is at gimbal lock.
    """
    cos_y = np.hypot(matrix[..., 2, 2], matrix[..., 1, 2])
    free = cos_y > _GIMBAL_EPS
    x = np.where(free, np.arctan2(-matrix[..., 1, 2], matrix[..., 2, 2]), 0.0)
    y = np.arctan2(matrix[..., 0, 2], cos_y)
    z = np.where(
        free,
        np.arctan2(-matrix[..., 0, 1], matrix[..., 0, 0]),
        np.arctan2(matrix[..., 1, 0], matrix[..., 1, 1]),
    )
    return np.stack([x, y, z], axis=-1)
