"""The parts of the environments around the Fetch robot, for any number of objects.

`N` simulations, `n` objects. Velocities in observations are per control step, as in the reference.
"""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from sldr_core.config import Phase, Robot, TableScene
from sldr_core.envs.parts import EnvParts, ObjectActuation, Starts
from sldr_core.envs.rotations import euler_from_matrix
from sldr_core.envs.scenes.welds import SUBSTEPS, object_mocap
from sldr_core.envs.simulation import Array, Simulation

GRIPPER_SPEED = np.float32(0.05)
"""Change of the gripper's target per control step at full action [m]."""

_FINGERS = ("robot0:r_gripper_finger_joint", "robot0:l_gripper_finger_joint")


def robot_stays(phase: Phase, robot: Robot) -> bool:
    """Tell whether the robot is in the scene: in locomotion it is removed unless told otherwise."""
    return phase == "manipulation" or robot in ("still", "random")


def fetch_parts(
    scene: TableScene, objects: int, acted: Sequence[int], phase: Phase, simulation: Simulation, starts: Starts
) -> EnvParts:
    """Put the parts of a scene around the Fetch robot together.

    Args:
        scene: the scene.
        objects: objects that are observed, `n`.
        acted: those that move themselves in locomotion.
        phase: who acts.
        simulation: the scene's simulations.
        starts: where episodes start.
    """
    has_robot = simulation.has_body("robot0:mocap")
    gripper = GripperActuation(simulation, scene.gripper_blocked) if has_robot else None
    if phase == "manipulation":
        assert gripper is not None
        actor, bystander, observer = gripper, None, RobotObserver(simulation, objects)
    else:
        mocaps = [simulation.mocap(object_mocap(index), f"object{index}") for index in acted]
        actor, bystander, observer = ObjectActuation(mocaps), gripper, ObjectObserver(simulation, objects)
    return EnvParts(
        simulation=simulation,
        actor=actor,
        bystander=bystander,
        observer=observer,
        starts=starts,
        hold=FingerHold(simulation) if scene.gripper_blocked else None,
    )


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


class _Objects:
    """Read positions, rotations and velocities of n objects off a scene."""

    def __init__(self, simulation: Simulation, objects: int) -> None:
        self._simulation = simulation
        self._sites = [simulation.site(f"object{index}") for index in range(objects)]
        self._indices = [site.index for site in self._sites]
        self._dt = SUBSTEPS * simulation.model.opt.timestep

    def positions(self) -> Array:
        """Return centres [m], `[N, n, 3]`."""
        return self._simulation.site_pos[:, self._indices]

    def eulers(self) -> Array:
        """Return Euler angles [rad], `[N, n, 3]`."""
        matrices = self._simulation.site_mat[:, self._indices]
        return euler_from_matrix(matrices.reshape(*matrices.shape[:2], 3, 3))

    def velocities(self) -> tuple[Array, Array]:
        """Return linear [m] and angular [rad] velocities per control step, each `[N, n, 3]`."""
        moved = np.empty((2, self._simulation.num_envs, len(self._sites), 3))
        for place, site in enumerate(self._sites):
            moved[0, :, place], moved[1, :, place] = site.velocity()
        return moved[0] * self._dt, moved[1] * self._dt


class ObjectObserver:
    """See the objects alone: positions, Euler angles, linear and angular velocities; `D` = 12 n."""

    def __init__(self, simulation: Simulation, objects: int) -> None:
        self._objects = _Objects(simulation, objects)

    def observe(self) -> Array:
        """Return the objects' state `[N, 12 n]`."""
        positions = self._objects.positions()
        seen = (positions, self._objects.eulers(), *self._objects.velocities())
        return np.concatenate([values.reshape(len(positions), -1) for values in seen], axis=1)

    def achieved(self) -> Array:
        """Return the objects' positions [m], `[N, 3 n]`."""
        positions = self._objects.positions()
        return positions.reshape(len(positions), -1)


class RobotObserver:
    """See what the robot sees, in the reference's order; `D` = 10 + 15 n."""

    def __init__(self, simulation: Simulation, objects: int) -> None:
        self._simulation = simulation
        self._objects = _Objects(simulation, objects)
        self._grip = simulation.site("robot0:grip")
        model = simulation.model
        self._finger_qpos = [int(model.joint(name).qposadr[0]) for name in _FINGERS]
        self._finger_dof = [int(model.joint(name).dofadr[0]) for name in _FINGERS]
        self._dt = SUBSTEPS * model.opt.timestep

    def observe(self) -> Array:
        """Return observations `[N, 10 + 15 n]`.

        Grip position 3, object positions 3 n, their differences 3 n, fingers 2, the objects' Euler angles 3 n, their
        velocities relative to the grip 3 n, their spins 3 n, the grip's velocity 3, the fingers' velocities 2.
        """
        positions = self._objects.positions()
        linear, angular = self._objects.velocities()
        grip, grip_velocity = self._grip.pos, self._grip.velocity()[0] * self._dt
        seen = (
            grip,
            positions,
            positions - grip[:, None],
            self._simulation.qpos[:, self._finger_qpos],
            self._objects.eulers(),
            linear - grip_velocity[:, None],
            angular,
            grip_velocity,
            self._simulation.qvel[:, self._finger_dof] * self._dt,
        )
        return np.concatenate([values.reshape(len(positions), -1) for values in seen], axis=1)

    def achieved(self) -> Array:
        """Return the objects' positions [m], `[N, 3 n]`."""
        positions = self._objects.positions()
        return positions.reshape(len(positions), -1)


class FingerHold:
    """Keep the fingers shut after each control step, and bring what is read off the scene up to date."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        names = [name for name in _FINGERS if simulation.has_joint(name)]
        self._qpos = [int(simulation.model.joint(name).qposadr[0]) for name in names]

    def apply(self) -> None:
        """Write the fingers' positions."""
        self._simulation.qpos[:, self._qpos] = 0.0
        self._simulation.forward_motion()
