"""Which objects the robot touches, found from positions alone: nothing that is simulated changes.

`n` states, `O` objects.
"""

from __future__ import annotations

import re

import mujoco
import numpy as np
from numpy.typing import NDArray

from sldr_core.envs.simulation import Array

_ROBOT = re.compile(r"robot0:.*")
_OBJECT = re.compile(r"object\d*")


class TouchSense:
    """Look for contacts between robot and objects in states of one scene.

    Attributes:
        objects: bodies of the objects, in the order of the scene.
        has_robot: whether anything is there that could touch them.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model
        self._data = mujoco.MjData(model)
        bodies = [model.body(body).name for body in range(model.nbody)]
        self.objects = tuple(name for name in bodies if _OBJECT.fullmatch(name))
        numbers = np.array([self.objects.index(name) if name in self.objects else -1 for name in bodies])
        robot = np.array([_ROBOT.fullmatch(name) is not None for name in bodies])
        self._object_of = numbers[model.geom_bodyid]
        self._is_robot = robot[model.geom_bodyid]
        self.has_robot = bool(self._is_robot.any())

    def touches(self, qpos: Array) -> NDArray[np.bool_]:
        """Return whether the robot touches each object `[n, O]` where joints are at `qpos` `[n, nq]`."""
        touched = np.zeros((len(qpos), len(self.objects)), dtype=np.bool_)
        if self.has_robot:
            for row, positions in zip(touched, qpos, strict=True):
                self._data.qpos[:] = positions
                mujoco.mj_kinematics(self._model, self._data)
                mujoco.mj_collision(self._model, self._data)
                row[self._touched_objects()] = True
        return touched

    def _touched_objects(self) -> NDArray[np.int64]:
        """Return the objects in the contacts that were just found, once for each."""
        first, second = self._data.contact.geom.T
        met = np.concatenate(
            [self._object_of[first[self._is_robot[second]]], self._object_of[second[self._is_robot[first]]]]
        )
        return met[met >= 0]
