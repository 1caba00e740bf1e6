"""The parts of a Fetch environment: how an action moves the scene, what is observed, where episodes start.

`N` simulations. Velocities in observations are per control step, as in the reference.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

from sldr_core.config import TaskSpec
from sldr_core.envs.rotations import euler_from_matrix
from sldr_core.envs.scenes.fetch import OBJECT_MOCAP, SUBSTEPS, FetchStart
from sldr_core.envs.simulation import Array, Simulation

GRIPPER_SPEED = np.float32(0.05)
"""Change of the gripper's target per control step at full action [m]."""

OBJECT_SPEED = np.float32(0.05)
"""Change of the object's target per control step at full action [m, and raw quaternion units]."""

MIN_GRIPPER_DISTANCE = 0.1
"""An object never starts nearer to the gripper than this, in the plane [m]."""

AIR_PROBABILITY = 0.5
"""Share of goals above the table, where the task has such goals."""

MAX_AIR_HEIGHT = 0.45
"""Highest goal above the table [m]."""

_FINGERS = ("robot0:r_gripper_finger_joint", "robot0:l_gripper_finger_joint")


class Actuation(Protocol):
    """Turn actions into targets of the physics."""

    def apply(self, action: NDArray[np.float32]) -> None:
        """Set the targets for the next control step from actions `[N, A]` in [-1, 1]."""
        ...


class GripperActuation:
    """Move the gripper by a mocap weld and the fingers by their actuators: x, y, z, opening."""

    def __init__(self, simulation: Simulation, blocked: bool) -> None:
        self._simulation = simulation
        self._mocap = simulation.mocap("robot0:mocap", "robot0:gripper_link")
        self._turn = np.array([1.0, 0.0, 1.0, 0.0])
        self._blocked = blocked
        model = simulation.model
        self._finger_qpos = model.jnt_qposadr[model.actuator_trnid[:, 0]]
        self._relative = model.actuator_biastype != mujoco.mjtBias.mjBIAS_NONE

    def apply(self, action: NDArray[np.float32]) -> None:
        """Set the gripper's targets from `[N, 4]`."""
        self._mocap.pull(GRIPPER_SPEED * action[:, :3], self._turn)
        if self._simulation.model.nu:
            opening = np.zeros_like(action[:, 3:4]) if self._blocked else action[:, 3:4]
            base = np.where(self._relative, self._simulation.qpos[:, self._finger_qpos], 0.0)
            self._simulation.ctrl[:] = base + opening


class ObjectActuation:
    """Move the object itself by a mocap weld: position change and raw quaternion change (paper §5)."""

    def __init__(self, simulation: Simulation) -> None:
        self._mocap = simulation.mocap(OBJECT_MOCAP, "object0")

    def apply(self, action: NDArray[np.float32]) -> None:
        """Set the object's targets from `[N, 7]`."""
        self._mocap.pull(OBJECT_SPEED * action[:, :3], OBJECT_SPEED * action[:, 3:7])


class Observer(Protocol):
    """Read observations and achieved goals off the scene."""

    def observe(self) -> Array:
        """Return observations `[N, D]`."""
        ...

    def achieved(self) -> Array:
        """Return achieved goals `[N, G]`."""
        ...


class ObjectObserver:
    """See the object alone: position, Euler angles, linear and angular velocity; `D` = 12."""

    def __init__(self, simulation: Simulation) -> None:
        self._object = simulation.site("object0")
        self._dt = SUBSTEPS * simulation.model.opt.timestep

    def observe(self) -> Array:
        """Return the object's state `[N, 12]`."""
        linear, angular = self._object.velocity()
        euler = euler_from_matrix(self._object.mat)
        return np.concatenate([self._object.pos, euler, linear * self._dt, angular * self._dt], axis=1)

    def achieved(self) -> Array:
        """Return the object's position [m], `[N, 3]`."""
        return self._object.pos.copy()


class RobotObserver:
    """See what the robot sees, in the reference's order; `D` = 25."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._object = simulation.site("object0")
        self._grip = simulation.site("robot0:grip")
        model = simulation.model
        self._finger_qpos = [int(model.joint(name).qposadr[0]) for name in _FINGERS]
        self._finger_dof = [int(model.joint(name).dofadr[0]) for name in _FINGERS]
        self._dt = SUBSTEPS * model.opt.timestep

    def observe(self) -> Array:
        """Return observations `[N, 25]`.

        Grip position 3, object position 3, their difference 3, fingers 2, the object's Euler angles 3, its velocity
        relative to the grip 3, its spin 3, the grip's velocity 3, the fingers' velocities 2.
        """
        linear, angular = self._object.velocity()
        grip_velocity = self._grip.velocity()[0] * self._dt
        return np.concatenate(
            [
                self._grip.pos,
                self._object.pos,
                self._object.pos - self._grip.pos,
                self._simulation.qpos[:, self._finger_qpos],
                euler_from_matrix(self._object.mat),
                linear * self._dt - grip_velocity,
                angular * self._dt,
                grip_velocity,
                self._simulation.qvel[:, self._finger_dof] * self._dt,
            ],
            axis=1,
        )

    def achieved(self) -> Array:
        """Return the object's position [m], `[N, 3]`."""
        return self._object.pos.copy()


@dataclass(frozen=True)
class Start:
    """Where one episode starts and what it is to reach."""

    qpos: NDArray[np.float64]
    """`[nq]`."""
    qvel: NDArray[np.float64]
    """`[nv]`."""
    goal: NDArray[np.float64]
    """`[G]` [m]."""


class FetchStarts:
    """Draw starts and goals around the gripper's start, as the reference does."""

    def __init__(self, task: TaskSpec, start: FetchStart, simulation: Simulation) -> None:
        self._task = task
        self._start = start
        model = simulation.model
        self._object = int(model.joint("object0:joint").qposadr[0])
        has_robot = model.nq == start.qpos.size
        self._qpos = start.qpos if has_robot else start.object_pose
        self._qvel = start.qvel if has_robot else np.zeros(model.nv)

    def draw(self, rng: np.random.Generator) -> Start:
        """Draw one episode's start."""
        qpos = self._qpos.copy()
        qpos[self._object : self._object + 2] = self._draw_object(rng)
        return Start(qpos=qpos, qvel=self._qvel, goal=self._draw_goal(rng))

    def _draw_object(self, rng: np.random.Generator) -> NDArray[np.float64]:
        reach = self._task.object_range
        while True:
            offset = rng.uniform(-reach, reach, size=2)
            if np.hypot(offset[0], offset[1]) >= MIN_GRIPPER_DISTANCE:
                return self._start.gripper_pos[:2] + offset

    def _draw_goal(self, rng: np.random.Generator) -> NDArray[np.float64]:
        reach = self._task.target_range
        goal = self._start.gripper_pos + rng.uniform(-reach, reach, size=3) + self._task.target_offset
        goal[2] = self._start.object_height
        if self._task.target_in_the_air and rng.uniform() < AIR_PROBABILITY:
            goal[2] += rng.uniform(0.0, MAX_AIR_HEIGHT)
        return goal


class FingerHold:
    """Keep the fingers shut after each control step, and bring derived values up to date."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        names = [name for name in _FINGERS if _has_joint(simulation.model, name)]
        self._qpos = [int(simulation.model.joint(name).qposadr[0]) for name in names]

    def apply(self) -> None:
        """Write the fingers' positions."""
        self._simulation.qpos[:, self._qpos] = 0.0
        self._simulation.forward()


def _has_joint(model: mujoco.MjModel, name: str) -> bool:
    return mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name) >= 0
