"""What the tests of the hand's objects share: where an object's pose is found, and a simple way to its goal."""

from __future__ import annotations

import numpy as np

from sldr_core.config import PoseGoal
from sldr_core.envs import Envs, Observation

LOCOMOTION_TASKS = (
    "HandEggRotate",
    "HandBlockRotate",
    "HandEggTranslate",
    "HandBlockTranslate",
    "HandPenTranslate",
    "HandPenRotateXYZ",
)
MANIPULATION_TASKS = (
    "HandEggRotate",
    "HandBlockRotate",
    "HandPenRotate",
    "HandEggFull",
    "HandBlockFull",
    "HandPenFull",
)

LIFT = np.array([0.0, 0.0, 0.12])
"""Where an object turns that may turn anywhere: above the fingers, the pen too [m]."""

FULL_CHANGE = 0.05
"""Change of position [m] and of the quaternion that a full action asks for."""


def pose_slice(envs: Envs) -> slice:
    """Return where the object's pose is found in `qpos`."""
    start = int(envs.model.joint("object:joint").qposadr[0])
    return slice(start, start + 7)


def proportional_actions(envs: Envs, now: Observation, home: np.ndarray) -> np.ndarray:
    """Return actions `[N, 7]` straight to the goal; where the place does not count, above `home` `[N, 3]`."""
    goal, position, turned = envs.spec.goal, now.achieved[:, :3], now.achieved[:, 3:]
    assert isinstance(goal, PoseGoal)
    wanted_position = now.goal[:, :3] if goal.distance is not None else home + LIFT
    wanted_turn = now.goal[:, 3:] if goal.angle is not None else turned
    nearer = np.where((turned * wanted_turn).sum(axis=1, keepdims=True) < 0.0, -1.0, 1.0)
    change = np.concatenate([wanted_position - position, nearer * wanted_turn - turned], axis=1) / FULL_CHANGE
    return np.concatenate([_within_one(change[:, :3]), _within_one(change[:, 3:])], axis=1)


def _within_one(change: np.ndarray) -> np.ndarray:
    """Shorten a change, in its direction, until no entry is beyond 1."""
    return change / np.maximum(np.abs(change).max(axis=1, keepdims=True), 1.0)
