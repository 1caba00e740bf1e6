"""What an object's action asks for, as a person can see it: a way to go and a way to turn.

`M` bodies that are pulled: one, of a chain its two ends. `A` = 7 M.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sldr_core.envs.parts import OBJECT_SPEED, POSE_CHANGE
from sldr_core.envs.rotations import rotation_vector, turn_between

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Wish:
    """Say where each body wants to be in one control step, and how turned."""

    move: Array
    """Way to go [m], `[M, 3]`."""
    turn: Array
    """Rotation vector about the world's axes [rad], `[M, 3]`."""


def read_wish(action: NDArray[np.floating], quaternion: NDArray[np.floating]) -> Wish:
    """Return what an action asks for (facts of the reference: changes are added, then the quaternion is made whole).

    Args:
        action: `[A]`, clipped to [-1, 1] as the physics does.
        quaternion: how the bodies are turned now, `[M, 4]`, w first.
    """
    change = float(OBJECT_SPEED) * np.clip(np.asarray(action, dtype=np.float64), -1.0, 1.0).reshape(-1, POSE_CHANGE)
    turned = quaternion + change[:, 3:]
    turned = turned / np.linalg.norm(turned, axis=1, keepdims=True)
    return Wish(change[:, :3], rotation_vector(turn_between(quaternion, turned)))
