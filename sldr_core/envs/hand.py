"""The parts of a hand environment: how an action moves the fingers, what is observed, where episodes start.

`N` simulations. Velocities in observations are per second, as in the reference.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from sldr_core.config import HandScene
from sldr_core.envs.parts import Start
from sldr_core.envs.rotations import multiply_quaternions, quaternion_about
from sldr_core.envs.scenes.hand import OBJECT, TARGET
from sldr_core.envs.scenes.welds import SUBSTEPS
from sldr_core.envs.simulation import Array, Ids, Simulation

SETTLING_STEPS = 10
"""Control steps in which the object comes to rest on the palm."""

TARGET_ASIDE = (0.15, 0.0, 0.0)
"""Where the target stands beside its goal when only its rotation counts, so as not to hide the object [m]."""

_ROBOT_PREFIX = "robot0:"


class HandActuation:
    """Send the actuated joints to positions in their ranges: -1 to the lowest, 1 to the highest."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        low, high = simulation.model.actuator_ctrlrange.T
        self._low, self._high = low.copy(), high.copy()
        self._centre, self._reach = (high + low) / 2.0, (high - low) / 2.0

    def apply(self, action: NDArray[np.float32]) -> None:
        """Set the joints' targets from `[N, 20]`."""
        self._simulation.ctrl[:] = np.clip(self._centre + action * self._reach, self._low, self._high)


class HandObjectObserver:
    """See the object alone: velocity 6, position and quaternion 7; `D` = 13."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._pose, self._velocity = _free_joint(simulation, OBJECT)

    def observe(self) -> Array:
        """Return the object's state `[N, 13]`."""
        simulation = self._simulation
        return np.concatenate([simulation.qvel[:, self._velocity], simulation.qpos[:, self._pose]], axis=1)

    def achieved(self) -> Array:
        """Return the object's position [m] and quaternion, `[N, 7]`."""
        return self._simulation.qpos[:, self._pose].copy()


class HandRobotObserver:
    """See what the robot sees: positions 24 and velocities 24 of its joints, then the object's state; `D` = 61."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._object = HandObjectObserver(simulation)
        model = simulation.model
        joints = [joint for joint in range(model.njnt) if model.joint(joint).name.startswith(_ROBOT_PREFIX)]
        self._qpos, self._dofs = model.jnt_qposadr[joints], model.jnt_dofadr[joints]

    def observe(self) -> Array:
        """Return observations `[N, 61]`, in the reference's order."""
        simulation = self._simulation
        return np.concatenate(
            [simulation.qpos[:, self._qpos], simulation.qvel[:, self._dofs], self._object.observe()], axis=1
        )

    def achieved(self) -> Array:
        """Return the object's position [m] and quaternion, `[N, 7]`."""
        return self._object.achieved()


class HandStarts:
    """Drop the object on the palm and draw a goal around where it comes to rest, as the reference does."""

    def __init__(self, scene: HandScene, settling: Simulation) -> None:
        """Keep `settling`, a batch of its own in which objects come to rest; no weld may pull in it."""
        self._scene = scene
        self._settling = settling
        self._hand = HandActuation(settling)
        self._pose, _ = _free_joint(settling, OBJECT)
        self._target, _ = _free_joint(settling, TARGET)
        self._height = self._pose.start + 2
        self._qpos = settling.model.qpos0.copy()

    def draw(self, rngs: Sequence[np.random.Generator]) -> Start:
        """Draw and settle starts, then draw goals; those whose object fell off the palm are drawn again."""
        settling = self._settling
        ids = np.arange(len(rngs))
        while ids.size:
            self._settle(ids, np.stack([self._draw_start(rngs[index]) for index in ids.tolist()]))
            ids = ids[settling.qpos[ids, self._height] <= self._scene.min_height]
        qpos, qvel = settling.qpos[: len(rngs)].copy(), settling.qvel[: len(rngs)].copy()
        poses = qpos[:, self._pose]
        goal = np.stack([self._draw_goal(rng, pose) for rng, pose in zip(rngs, poses, strict=True)])
        qpos[:, self._target] = _target_pose(self._scene, goal)
        return Start(qpos=qpos, qvel=qvel, goal=goal)

    def _settle(self, ids: Ids, qpos: Array) -> None:
        settling = self._settling
        settling.reset(ids, qpos, np.zeros((ids.size, settling.model.nv)))
        self._hand.apply(np.zeros((1, settling.model.nu), dtype=np.float32))
        settling.step(SETTLING_STEPS * SUBSTEPS, ids)

    def _draw_start(self, rng: np.random.Generator) -> Array:
        qpos = self._qpos.copy()
        pose = qpos[self._pose]
        if self._scene.start_rotation_random:
            pose[3:] = multiply_quaternions(pose[3:], _draw_rotation(rng))
        pose[:3] += rng.normal(scale=self._scene.start_position_std, size=3)
        return qpos

    def _draw_goal(self, rng: np.random.Generator, pose: Array) -> Array:
        goal = pose.copy()
        if self._scene.target_position == "random":
            low, high = np.transpose(self._scene.target_range)
            goal[:3] += rng.uniform(low, high)
        if self._scene.target_rotation == "xyz":
            goal[3:] = _draw_rotation(rng)
        return goal


class TargetMarker:
    """Show goals by the target's body."""

    def __init__(self, scene: HandScene, simulation: Simulation) -> None:
        self._scene = scene
        self._simulation = simulation
        self._target, _ = _free_joint(simulation, TARGET)

    def show(self, ids: Ids, goal: Array) -> None:
        """Put the targets of simulations `ids` to goals `[len(ids), 7]`."""
        self._simulation.qpos[ids, self._target] = _target_pose(self._scene, goal)


def _target_pose(scene: HandScene, goal: Array) -> Array:
    """Return where the target stands that shows goals `[N, 7]`."""
    aside = np.zeros(7)
    if scene.target_position == "ignore":
        aside[:3] = TARGET_ASIDE
    return goal + aside


def _draw_rotation(rng: np.random.Generator) -> Array:
    """Draw a rotation by any angle about an axis through any point of a cube, as the reference does, `[4]`."""
    angle = rng.uniform(-np.pi, np.pi)
    return quaternion_about(rng.uniform(-1.0, 1.0, size=3), angle)


def _free_joint(simulation: Simulation, body: str) -> tuple[slice, slice]:
    """Return where the position and the velocity of a free body are found."""
    joint = simulation.model.joint(f"{body}:joint")
    start, first = int(joint.qposadr[0]), int(joint.dofadr[0])
    return slice(start, start + 7), slice(first, first + 6)
