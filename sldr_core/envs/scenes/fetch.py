"""The Fetch scenes: the reference's own models, with what object locomotion adds and takes away."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import Literal

import mujoco
import numpy as np
from numpy.typing import NDArray

from sldr_core.config import Phase, TaskSpec
from sldr_core.errors import BadFile

SUBSTEPS = 20
"""Physics steps of 0.002 s in one control step."""

SETTLING_STEPS = 10
"""Control steps that bring the gripper to its start."""

OBJECT_MOCAP = "object0:mocap"
"""The mocap body that moves the object in locomotion."""

_GRIPPER_TARGET = (-0.498, 0.005, -0.431)
"""The gripper's start, relative to where the model's own pose puts it [m]."""

_GRIPPER_QUAT = (1.0, 0.0, 1.0, 0.0)
"""Fingers down."""

_ROBOT_PREFIX = "robot0:"

Robot = Literal["absent", "still", "random"]


@dataclass(frozen=True)
class FetchStart:
    """What every episode of a task starts from, found by settling the scene once."""

    qpos: NDArray[np.float64]
    """Settled positions of the whole scene with its robot, `[nq]`."""
    qvel: NDArray[np.float64]
    """Settled velocities of the whole scene with its robot, `[nv]`."""
    object_pose: NDArray[np.float64]
    """The object's settled position [m] and quaternion, `[7]`."""
    gripper_pos: NDArray[np.float64]
    """The gripper's start [m], `[3]`; starts and goals are drawn around it."""
    object_height: float
    """Height of the object's centre when it lies on the table [m]."""


def build_fetch(task: TaskSpec, phase: Phase, robot: Robot) -> mujoco.MjModel:
    """Build the scene of one phase.

    In manipulation it is the reference's model, unchanged. In locomotion a mocap body is welded to the object,
    and the robot is taken out if `robot` is `absent`.
    """
    spec = mujoco.MjSpec.from_file(str(_model_path(task)))
    if phase == "locomotion":
        if robot == "absent":
            _remove_robot(spec)
        _add_object_weld(spec)
    model = spec.compile()
    _straighten_welds(model, task)
    return model


@lru_cache(maxsize=32)
def settle_fetch(task: TaskSpec) -> FetchStart:
    """Bring the gripper to its start and read off where everything lies, as the reference does."""
    model = build_fetch(task, "manipulation", "still")
    data = mujoco.MjData(model)
    for axis, value in enumerate(task.start_base):
        data.joint(f"robot0:slide{axis}").qpos[:] = value
    data.joint("object0:joint").qpos[:] = (*task.start_object, 1.0, 0.0, 0.0, 0.0)
    mujoco.mj_forward(model, data)
    data.mocap_pos[0] = data.site("robot0:grip").xpos + _GRIPPER_TARGET
    data.mocap_pos[0, 2] += task.gripper_extra_height
    data.mocap_quat[0] = _GRIPPER_QUAT
    mujoco.mj_step(model, data, nstep=SETTLING_STEPS * SUBSTEPS)
    return FetchStart(
        qpos=data.qpos.copy(),
        qvel=data.qvel.copy(),
        object_pose=data.joint("object0:joint").qpos.copy(),
        gripper_pos=data.site("robot0:grip").xpos.copy(),
        object_height=float(data.site("object0").xpos[2]),
    )


def _model_path(task: TaskSpec) -> Path:
    # Found without being imported: importing it costs a second and prints warnings about other environments.
    package = find_spec("gymnasium_robotics")
    if package is None or package.submodule_search_locations is None:
        raise BadFile("The package gymnasium-robotics, which ships the scenes, is not installed.")
    return Path(package.submodule_search_locations[0]) / "envs" / "assets" / task.model_file


def _remove_robot(spec: mujoco.MjSpec) -> None:
    for body in [body for body in spec.worldbody.bodies if body.name.startswith(_ROBOT_PREFIX)]:
        spec.delete(body)


def _add_object_weld(spec: mujoco.MjSpec) -> None:
    spec.worldbody.add_body(name=OBJECT_MOCAP, mocap=True)
    weld = spec.add_equality(name=OBJECT_MOCAP, name1=OBJECT_MOCAP, name2="object0")
    weld.type = mujoco.mjtEq.mjEQ_WELD
    weld.objtype = mujoco.mjtObj.mjOBJ_BODY
    weld.solref[:2] = (0.02, 1.0)
    weld.solimp[:3] = (0.9, 0.95, 0.001)


def _straighten_welds(model: mujoco.MjModel, task: TaskSpec) -> None:
    """Make every weld hold its two bodies in the same pose.

    The robot's weld gets the very numbers of the reference, which writes the first seven entries only: they
    are part of the physics that ours has to equal.
    """
    for weld in range(model.neq):
        if mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_EQUALITY, weld) == OBJECT_MOCAP:
            model.eq_data[weld] = (0, 0, 0, 0, 0, 0, 1, 0, 0, 0, task.weld_torque_scale)
        else:
            model.eq_data[weld, :7] = (0, 0, 0, 0, 0, 0, 1)
