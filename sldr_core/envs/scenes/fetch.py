"""The scenes around the Fetch robot: the reference's own models, with what our tasks add and take away."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import mujoco
import numpy as np
from numpy.typing import NDArray

from sldr_core.config import FetchScene, TableScene
from sldr_core.envs.scenes.once import compiled_once
from sldr_core.envs.scenes.welds import (
    SUBSTEPS,
    add_object_weld,
    load_model,
    remove_bodies,
    straighten_welds,
)

__all__ = ["FetchStart", "build_fetch", "build_table", "settle_fetch", "settle_table"]

SETTLING_STEPS = 10
"""Control steps that bring the gripper to its start."""

_GRIPPER_TARGET = (-0.498, 0.005, -0.431)
"""The gripper's start, relative to where the model's own pose puts it [m]."""

_GRIPPER_QUAT = (1.0, 0.0, 1.0, 0.0)
"""Fingers down."""

_ROBOT_PREFIX = "robot0:"

_FIRST_JOINT = "object0:joint"


@dataclass(frozen=True)
class FetchStart:
    """What every episode of a task starts from, found by settling the scene once."""

    qpos: NDArray[np.float64]
    """Settled positions of the whole scene with its robot, `[nq]`."""
    qvel: NDArray[np.float64]
    """Settled velocities of the whole scene with its robot, `[nv]`."""
    object_qpos: NDArray[np.float64]
    """The end of `qpos`, that of the objects alone."""
    gripper_pos: NDArray[np.float64]
    """The gripper's start [m], `[3]`; starts and goals are drawn around it."""
    object_height: float
    """Height of the first object's centre when it lies on the table [m]."""


@compiled_once
def build_fetch(scene: FetchScene, acted: tuple[int, ...], has_robot: bool, torque_scale: float) -> mujoco.MjModel:
    """Build the scene with one object: in manipulation it is the reference's model, unchanged."""
    return build_table(load_model(scene.model_file), acted, has_robot, torque_scale)


@lru_cache(maxsize=32)
def settle_fetch(scene: FetchScene) -> FetchStart:
    """Bring the gripper to its start and read off where everything lies, as the reference does."""
    return settle_table(scene, build_fetch(scene, (), True, 1.0))


def build_table(spec: mujoco.MjSpec, acted: Sequence[int], has_robot: bool, torque_scale: float) -> mujoco.MjModel:
    """Finish a scene.

    Args:
        spec: table, robot and objects.
        acted: objects that move themselves: a mocap body is welded to each.
        has_robot: whether the robot stays.
        torque_scale: torque scale of the objects' welds.
    """
    if not has_robot:
        remove_bodies(spec, _ROBOT_PREFIX)
    for index in acted:
        add_object_weld(spec, index, f"object{index}")
    model = spec.compile()
    straighten_welds(model, torque_scale)
    return model


def settle_table(scene: TableScene, model: mujoco.MjModel) -> FetchStart:
    """Settle a scene with its robot; its objects lie where the model has them, the first at `scene.start_object`."""
    data = mujoco.MjData(model)
    for axis, value in enumerate(scene.start_base):
        data.joint(f"robot0:slide{axis}").qpos[:] = value
    data.joint(_FIRST_JOINT).qpos[:] = (*scene.start_object, 1.0, 0.0, 0.0, 0.0)
    mujoco.mj_forward(model, data)
    data.mocap_pos[0] = data.site("robot0:grip").xpos + _GRIPPER_TARGET
    data.mocap_pos[0, 2] += scene.gripper_extra_height
    data.mocap_quat[0] = _GRIPPER_QUAT
    mujoco.mj_step(model, data, nstep=SETTLING_STEPS * SUBSTEPS)
    first = int(model.joint(_FIRST_JOINT).qposadr[0])
    return FetchStart(
        qpos=data.qpos.copy(),
        qvel=data.qvel.copy(),
        object_qpos=data.qpos[first:].copy(),
        gripper_pos=data.site("robot0:grip").xpos.copy(),
        object_height=float(data.site("object0").xpos[2]),
    )
