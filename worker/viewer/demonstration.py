"""The demonstration beside the robot: what the locomotion policy makes the object do from a given moment.

The object's state at the robot's moment is put into the locomotion scene, and the locomotion policy acts there.
`G` goal, `K` steps.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
import torch
from numpy.typing import NDArray

from sldr_core.config import Part, TaskSpec
from sldr_core.envs import Envs, make_envs
from sldr_core.nets.locomotion_model import LocomotionModel
from sldr_core.nets.views import part_view
from worker.viewer.simulated import Array, Moment


@dataclass(frozen=True)
class JointCopy:
    """Say where the joints of one scene are found in another, by their names."""

    qpos_from: NDArray[np.int64]
    qpos_to: NDArray[np.int64]
    qvel_from: NDArray[np.int64]
    qvel_to: NDArray[np.int64]


class PartDemonstration:
    """Let one part of a task demonstrate, in a locomotion scene of its own.

    Attributes:
        part: the part, an object of a stack or a way of moving.
        model: its scene.
    """

    def __init__(self, task: TaskSpec, part: Part, model: LocomotionModel, robot_scene: mujoco.MjModel) -> None:
        """Build the scene.

        Args:
            task: the robot's task.
            part: one of its parts.
            model: the locomotion model of the part's locomotion task.
            robot_scene: the robot's scene, from which moments come.
        """
        config = model.config
        self.part = part
        self._nets = model.nets
        self._goal = part_view(task, part).part_goal
        self._envs: Envs = make_envs(
            config.task, "locomotion", robot=config.scene.locomotion_robot, variant=config.scene.variant
        )
        self.model = self._envs.model
        self._copy = match_joints(robot_scene, self.model, part.object_index if task.family == "stack" else 0)

    def one_step(self, moment: Moment) -> Array:
        """Return the joint positions of the locomotion scene one control step after a moment, `[nq]`."""
        return self.run(moment, 1)[1]

    def run(self, moment: Moment, steps: int) -> Array:
        """Return the joint positions of the locomotion scene from a moment on, `[K+1, nq]`."""
        self._place(moment)
        path = [self._envs.qpos[0].copy()]
        for _ in range(steps):
            seen = self._envs.observe()
            self._envs.step(self._wanted(seen.obs, seen.goal))
            path.append(self._envs.qpos[0].copy())
        return np.stack(path)

    def _place(self, moment: Moment) -> None:
        """Put the robot's moment into the locomotion scene: every joint that both have, and the part's goal."""
        envs, copied = self._envs, self._copy
        qpos, qvel = self.model.qpos0.copy()[None], np.zeros((1, self.model.nv))
        qpos[0, copied.qpos_to] = moment.qpos[copied.qpos_from]
        qvel[0, copied.qvel_to] = moment.qvel[copied.qvel_from]
        envs.simulation.reset(np.array([0]), qpos, qvel)
        envs.set_goal(self._goal(torch.from_numpy(np.asarray(moment.goal, dtype=np.float64))).numpy())

    @torch.no_grad()
    def _wanted(self, state: Array, goal: Array) -> NDArray[np.float32]:
        features = self._nets.features(*(torch.as_tensor(part, dtype=torch.float32) for part in (state, goal)))
        return self._nets.action(features).numpy()


def match_joints(source: mujoco.MjModel, target: mujoco.MjModel, object_index: int) -> JointCopy:
    """Find each joint of `target` in `source`; the first object of `target` is object `object_index` of `source`."""
    names = {source.joint(joint).name: joint for joint in range(source.njnt)}
    pairs = []
    for joint in range(target.njnt):
        name = target.joint(joint).name
        wanted = f"object{object_index}:joint" if name == "object0:joint" else name
        if wanted in names:
            pairs.append((names[wanted], joint))
    return JointCopy(
        _entries(source, [pair[0] for pair in pairs], source.jnt_qposadr, _QPOS_SIZE),
        _entries(target, [pair[1] for pair in pairs], target.jnt_qposadr, _QPOS_SIZE),
        _entries(source, [pair[0] for pair in pairs], source.jnt_dofadr, _QVEL_SIZE),
        _entries(target, [pair[1] for pair in pairs], target.jnt_dofadr, _QVEL_SIZE),
    )


_JOINT = mujoco.mjtJoint
_QPOS_SIZE = {_JOINT.mjJNT_FREE: 7, _JOINT.mjJNT_BALL: 4, _JOINT.mjJNT_SLIDE: 1, _JOINT.mjJNT_HINGE: 1}
_QVEL_SIZE = {_JOINT.mjJNT_FREE: 6, _JOINT.mjJNT_BALL: 3, _JOINT.mjJNT_SLIDE: 1, _JOINT.mjJNT_HINGE: 1}


def _entries(
    model: mujoco.MjModel, joints: list[int], first: NDArray[np.int32], sizes: dict[mujoco.mjtJoint, int]
) -> NDArray[np.int64]:
    """Return the numbers of all entries of some joints."""
    rows = [np.arange(first[joint], first[joint] + sizes[_JOINT(model.jnt_type[joint])]) for joint in joints]
    return np.concatenate(rows).astype(np.int64)
