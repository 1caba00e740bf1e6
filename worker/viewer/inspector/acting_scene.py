"""The scene that demonstrations are played in: that of the object alone, or of a stack whose objects act one by one.

`P` objects that act side by side, `B` bodies of the scene.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
import viser
from numpy.typing import NDArray

from sldr_core.config import StackScene, TaskSpec
from sldr_core.demonstrations.placing import joint_pose
from sldr_core.envs.scenes.hand import OBJECT
from sldr_core.envs.scenes.stack import build_stack
from worker.viewer.scene import SceneView
from worker.viewer.skeleton import Kinematics, Poses
from worker.viewer.tracks import goal_positions

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Moment:
    """What is drawn at one moment."""

    qpos: Array
    """Joint positions of the acting scene, `[P, nq]`."""
    goal: Array
    """`[P, G]`."""
    reached: NDArray[np.bool_]
    """`[P]`."""


class ActingScene:
    """Draw bodies and goals."""

    def __init__(self, server: viser.ViserServer, task: TaskSpec, acting: mujoco.MjModel) -> None:
        """Build the scene.

        Args:
            server: the page's server.
            task: whose starts and goals are drawn.
            acting: the scene in which each object acts.
        """
        scene = task.scene
        self._stack = scene.objects if isinstance(scene, StackScene) else 0
        self.model = build_stack(scene, has_robot=False) if isinstance(scene, StackScene) else acting
        self._server, self._acting, self._task = server, acting, task
        self._kinematics = Kinematics(self.model)
        self._view = SceneView(server, self.model, prefix=f"/{task.name}")

    def remove(self) -> None:
        """Take everything out of the page."""
        self._view.root.remove()

    def poses(self, qpos: Array) -> Poses:
        """Return where every body of the scene is, from joint positions `[P, nq]` of the acting one."""
        return self._kinematics.poses(self._whole(qpos))

    def poses_between(self, qpos: Array, later: Array, share: float) -> Poses:
        """Return where every body of the scene is, a share of the way between joint positions `[P, nq]`."""
        return self._kinematics.poses_between(self._whole(qpos), self._whole(later), share)

    def pulled_bodies(self) -> list[int]:
        """Return the bodies that act: of a chain its two ends, else every object."""
        if self._task.family == "hand":
            return [self.model.body(OBJECT).id]
        objects = self._stack or self._task.goal_size // 3
        indices = range(self._stack) if self._stack else sorted({0, objects - 1})
        return [self.model.body(f"object{index}").id for index in indices]

    def show(self, poses: Poses, moment: Moment) -> None:
        """Draw bodies and goals."""
        with self._server.atomic():
            self._view.show(poses)
            self._view.show_goals(goal_positions(self._task, moment.goal), bool(moment.reached.all()))

    def _whole(self, qpos: Array) -> Array:
        """Return the joint positions of the scene `[nq]`, from those of the acting one `[P, nq]`."""
        if not self._stack:
            return qpos[0]
        whole = self.model.qpos0.copy()
        for index in range(self._stack):
            whole[joint_pose(self.model, index)] = qpos[index, joint_pose(self._acting, 0)]
        return whole
