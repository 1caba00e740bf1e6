"""Rotations by MuJoCo's own functions, one at a time."""

from __future__ import annotations

import mujoco
import numpy as np


def quaternion_of(vector) -> np.ndarray:
    """Return the quaternion of a rotation vector."""
    angle = float(np.linalg.norm(vector))
    quaternion = np.empty(4)
    mujoco.mju_axisAngle2Quat(quaternion, np.asarray(vector, dtype=float) / (angle or 1.0), angle)
    return quaternion


def vector_of(quaternion) -> np.ndarray:
    """Return the rotation vector of a quaternion."""
    vector = np.empty(3)
    mujoco.mju_quat2Vel(vector, np.asarray(quaternion, dtype=float), 1.0)
    return vector


def product(a, b) -> np.ndarray:
    """Return the rotation `b` followed by `a`."""
    both = np.empty(4)
    mujoco.mju_mulQuat(both, np.asarray(a, dtype=float), np.asarray(b, dtype=float))
    return both


def inverse(quaternion) -> np.ndarray:
    """Return the rotation back."""
    back = np.empty(4)
    mujoco.mju_negQuat(back, np.asarray(quaternion, dtype=float))
    return back
