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
    angles = np.empty((*cos_y.shape, 3))
    angles[..., 0] = np.where(free, np.arctan2(-matrix[..., 1, 2], matrix[..., 2, 2]), 0.0)
    angles[..., 1] = np.arctan2(matrix[..., 0, 2], cos_y)
    angles[..., 2] = np.where(
        free,
        np.arctan2(-matrix[..., 0, 1], matrix[..., 0, 0]),
        np.arctan2(matrix[..., 1, 0], matrix[..., 1, 1]),
    )
    return angles


def angle_between(a: NDArray[np.floating], b: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return the angle [rad] of the rotation from `b` to `a`, in [0, pi].

    Args:
        a, b: unit quaternions `[..., 4]`, w first; their signs mean nothing.
    """
    return 2.0 * np.arccos(np.clip(np.abs((a * b).sum(axis=-1)), 0.0, 1.0))


def angle_between_axes(a: NDArray[np.floating], b: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return the angle [rad] from `b` to `a` once `a` has been given the third Euler angle of `b`, `[...]`."""
    euler = euler_from_quaternion(a)
    euler[..., 2] = euler_from_quaternion(b)[..., 2]
    return angle_between(quaternion_from_euler(euler), b)


def euler_from_quaternion(quaternion: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the angles x, y, z [rad] of unit quaternions `[..., 4]`, as `[..., 3]`."""
    return euler_from_matrix(matrix_from_quaternion(quaternion))


def matrix_from_quaternion(quaternion: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the rotation matrices `[..., 3, 3]` of quaternions `[..., 4]`, w first."""
    w, x, y, z = np.moveaxis(np.asarray(quaternion, dtype=np.float64), -1, 0)
    scale = 2.0 / (w * w + x * x + y * y + z * z)
    rows = [
        [1.0 - scale * (y * y + z * z), scale * (x * y - w * z), scale * (x * z + w * y)],
        [scale * (x * y + w * z), 1.0 - scale * (x * x + z * z), scale * (y * z - w * x)],
        [scale * (x * z - w * y), scale * (y * z + w * x), 1.0 - scale * (x * x + y * y)],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def quaternion_from_euler(euler: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the unit quaternions `[..., 4]`, w first, of angles x, y, z [rad] `[..., 3]`."""
    half = 0.5 * np.asarray(euler, dtype=np.float64)
    (cx, cy, cz), (sx, sy, sz) = np.moveaxis(np.cos(half), -1, 0), np.moveaxis(np.sin(half), -1, 0)
    return np.stack(
        [
            cx * cy * cz - sx * sy * sz,
            sx * cy * cz + cx * sy * sz,
            cx * sy * cz - sx * cy * sz,
            cx * cy * sz + sx * sy * cz,
        ],
        axis=-1,
    )


def multiply_quaternions(a: NDArray[np.floating], b: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the rotation `b` followed by `a`, as quaternions `[..., 4]`, w first."""
    aw, ax, ay, az = np.moveaxis(np.asarray(a, dtype=np.float64), -1, 0)
    bw, bx, by, bz = np.moveaxis(np.asarray(b, dtype=np.float64), -1, 0)
    return np.stack(
        [
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by + ay * bw + az * bx - ax * bz,
            aw * bz + az * bw + ax * by - ay * bx,
        ],
        axis=-1,
    )


def quaternion_about(axis: NDArray[np.floating], angle: float) -> NDArray[np.float64]:
    """Return the unit quaternion `[4]`, w first, of a turn by `angle` [rad] about `axis` `[3]` of any length."""
    direction = axis / np.linalg.norm(axis)
    return np.array([np.cos(angle / 2.0), *(np.sin(angle / 2.0) * direction)])


def quaternion_from_vector(vector: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the unit quaternions `[..., 4]`, w first, of rotation vectors [rad] `[..., 3]`."""
    vector = np.asarray(vector, dtype=np.float64)
    half = 0.5 * np.linalg.norm(vector, axis=-1, keepdims=True)
    # sin(h) / h without the division at no turn; np.sinc has a pi in it.
    return np.concatenate([np.cos(half), 0.5 * vector * np.sinc(half / np.pi)], axis=-1)


def rotation_vector(quaternion: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the rotation vectors [rad] `[..., 3]`, no longer than pi, of unit quaternions `[..., 4]`, w first."""
    quaternion = np.asarray(quaternion, dtype=np.float64)
    shorter = np.where(quaternion[..., :1] < 0.0, -quaternion, quaternion)
    sine = np.linalg.norm(shorter[..., 1:], axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(sine, shorter[..., :1])
    return shorter[..., 1:] * np.where(sine > 0.0, angle / np.where(sine > 0.0, sine, 1.0), 2.0)


def turn_between(a: NDArray[np.floating], b: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the rotations, about the world's axes, that bring `a` to `b`, all unit quaternions `[..., 4]`."""
    return multiply_quaternions(b, a * np.array([1.0, -1.0, -1.0, -1.0]))
