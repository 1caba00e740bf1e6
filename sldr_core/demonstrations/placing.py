"""Putting an object and its goal where a person wants them, within what the scene allows.

Positions in [m], quaternions w first.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from sldr_core.config import FetchScene, HandScene, PoseGoal, TaskSpec, TupleScene
from sldr_core.envs import Start

HAND_REACH = 0.1
"""Object and goal may be put this far from where objects come to rest on the palm [m]."""

AIR_REACH = 0.45
"""Object and goal may be put this far above the table [m]."""

_TABLE = "table0"
_HAND_JOINT = "object:joint"
_POSE = 7

Vector = NDArray[np.float64]


def joint_pose(model: mujoco.MjModel, index: int) -> slice:
    """Return where the pose of free object `index` is found in `qpos`."""
    has_table = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, _TABLE) >= 0
    start = int(model.joint(f"object{index}:joint" if has_table else _HAND_JOINT).qposadr[0])
    return slice(start, start + _POSE)


@dataclass(frozen=True)
class Placing:
    """Change a single start, `[1, ...]`: where the object lies, and where it is to go."""

    task: TaskSpec
    model: mujoco.MjModel
    """The scene in which the object acts."""
    rest: Vector
    """Where an object comes to rest [m], `[3]`."""

    def bounds(self) -> tuple[Vector, Vector]:
        """Return the least and the greatest position of object and goal [m], `[3]` each."""
        if isinstance(self.task.scene, HandScene):
            return self.rest - HAND_REACH, self.rest + HAND_REACH
        table, floor = self.model.body(_TABLE), float(self.rest[2])
        half = self.model.geom_size[int(table.geomadr[0]), :2]
        return np.array([*(table.pos[:2] - half), floor]), np.array([*(table.pos[:2] + half), floor + AIR_REACH])

    def object_pose(self, start: Start) -> tuple[Vector, Vector]:
        """Return position `[3]` and quaternion `[4]` of the object; of a chain, of its first block."""
        pose = start.qpos[0, joint_pose(self.model, 0)]
        return pose[:3].copy(), pose[3:].copy()

    def goal_pose(self, start: Start) -> tuple[Vector, Vector]:
        """Return position `[3]` and quaternion `[4]` of the goal; of a chain, of its first block."""
        goal = start.goal[0]
        turned = goal[3:] if isinstance(self.task.goal, PoseGoal) else np.array([1.0, 0.0, 0.0, 0.0])
        return goal[:3].copy(), turned.copy()

    def put_object(self, start: Start, position: ArrayLike, quaternion: ArrayLike) -> Start:
        """Return `start` with the object elsewhere. What of a pose is not scored has its goal there, too."""
        pose, goal = np.concatenate([self._within(position), _unit(quaternion)]), start.goal.copy()
        qpos = start.qpos.copy()
        qpos[0, joint_pose(self.model, 0)] = pose
        if isinstance(self.task.goal, PoseGoal):
            if self.task.goal.distance is None:
                goal[0, :3] = pose[:3]
            if self.task.goal.angle is None:
                goal[0, 3:] = pose[3:]
        return Start(qpos, start.qvel, goal)

    def put_goal(self, start: Start, position: ArrayLike, quaternion: ArrayLike) -> Start:
        """Return `start` with another goal; what the task does not score stays as it is."""
        goal, place = start.goal.copy(), self._within(position)
        if isinstance(self.task.goal, PoseGoal):
            if self.task.goal.distance is not None:
                goal[0, :3] = place
            if self.task.goal.angle is not None:
                goal[0, 3:] = _unit(quaternion)
            return replace(start, goal=goal)
        if isinstance(self.task.scene, FetchScene) and not self.task.scene.target_in_the_air:
            place[2] = goal[0, 2]
        blocks = goal.reshape(-1, 3)
        moved = blocks - blocks[0] + place
        # A chain's first block may be its highest: what would sink into the table is lifted.
        moved[:, 2] += max(0.0, float(self.rest[2] - moved[:, 2].min())) if len(blocks) > 1 else 0.0
        return replace(start, goal=moved.reshape(1, -1))

    def put_shape(self, start: Start, shape: int) -> Start:
        """Return `start` with a chain's goal in another of its shapes, in the same place.

        Raises:
            IndexError: the chain has no such shape.
        """
        assert isinstance(self.task.scene, TupleScene)
        offsets = np.array([(x, 0.0, z) for x, z in self.task.scene.shapes[shape].offsets])
        goal = offsets - _foot(offsets) + _foot(start.goal[0].reshape(-1, 3))
        return replace(start, goal=goal.reshape(1, -1))

    def _within(self, position: ArrayLike) -> Vector:
        low, high = self.bounds()
        return np.clip(np.asarray(position, dtype=np.float64), low, high)


def _foot(blocks: Vector) -> Vector:
    """Return the point below the middle of blocks `[n, 3]`, at the height of the lowest."""
    low, high = blocks.min(axis=0), blocks.max(axis=0)
    return np.array([*(0.5 * (low + high))[:2], low[2]])


def _unit(quaternion: ArrayLike) -> Vector:
    values = np.asarray(quaternion, dtype=np.float64)
    return values / np.linalg.norm(values)
