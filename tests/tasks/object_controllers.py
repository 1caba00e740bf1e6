"""Proportional controllers of objects that move themselves: they show that a task can be solved, and learn nothing.

`N` simulations, `n` blocks. Angles [rad], lengths [m].
"""

from __future__ import annotations

import numpy as np

from sldr_core.config import Shape, TupleScene
from sldr_core.envs import Envs
from sldr_core.envs.scenes.blocks import BLOCK_SIDE

STEP_LENGTH = 0.0325
"""What a full action moves an object by in one control step."""

STEP_QUATERNION = 0.0325
"""What a full action changes a quaternion's entry by in one control step."""

LIFT = 0.22
"""How far a chain is lifted before it is folded."""

LIFTED_AT, FOLDED_AT, LOWERED_AT = 8, 36, 44
"""Control steps by which a chain is lifted, folded above its goal, and put down."""


def pull_to_goal(envs: Envs) -> np.ndarray:
    """Return actions `[N, 7]` that move one object towards its goal in a straight line, without turning it."""
    now = envs.observe()
    actions = np.zeros((envs.num_envs, 7))
    actions[:, :3] = (now.goal - now.achieved) / STEP_LENGTH
    return actions


class ChainFolder:
    """Fold a chain in the air on the way that its joint angles take, and put it down.

    Only the two end blocks are moved; where they have to be follows from the chain's kinematics.
    """

    def __init__(self, envs: Envs) -> None:
        assert isinstance(envs.spec.scene, TupleScene)
        self._envs = envs
        self._scene = envs.spec.scene
        self._start = envs.observe().achieved.reshape(envs.num_envs, -1, 3)[:, 0]
        goals = envs.observe().goal.reshape(envs.num_envs, -1, 3)
        self._goal = goals[:, 0]
        self._shapes = [self._shape_of(goal) for goal in goals]
        self._bodies = [envs.model.body(f"object{index}").id for index in (0, self._scene.objects - 1)]

    def actions(self, step: int) -> np.ndarray:
        """Return actions `[N, 14]` of control step `step`, from 1."""
        lifted, folded, lowered = (
            np.clip((step - begin) / (end - begin), 0.0, 1.0)
            for begin, end in ((0, LIFTED_AT), (LIFTED_AT - 3, FOLDED_AT), (FOLDED_AT, LOWERED_AT))
        )
        actions = np.empty((self._envs.num_envs, 14))
        for index, shape in enumerate(self._shapes):
            root = self._start[index] + folded * (self._goal[index] - self._start[index])
            root[2] += LIFT * lifted * (1.0 - lowered)
            positions, pitches = place_blocks(
                self._scene, root, folded * shape.pitch, folded * np.array(shape.hinge_angles)
            )
            for end, block in enumerate((0, -1)):
                actions[index, 7 * end : 7 * end + 7] = self._pull(
                    index, self._bodies[end], positions[block], pitches[block]
                )
        return actions

    def _pull(self, index: int, body: int, position: np.ndarray, pitch: float) -> np.ndarray:
        simulation = self._envs.simulation
        now = simulation.body_quat[index, body]
        wanted = np.array([np.cos(pitch / 2), 0.0, np.sin(pitch / 2), 0.0])
        wanted *= 1.0 if wanted @ now >= 0.0 else -1.0
        return np.concatenate(
            [(position - simulation.body_pos[index, body]) / STEP_LENGTH, (wanted - now) / STEP_QUATERNION]
        )

    def _shape_of(self, goal: np.ndarray) -> Shape:
        def error(shape: Shape) -> float:
            offsets = np.array(shape.offsets)
            wanted = goal[:, [0, 2]] - goal[0, [0, 2]]
            return float(np.abs(offsets - offsets[0] - wanted).max())

        return min(self._scene.shapes, key=error)


def place_blocks(
    scene: TupleScene, root: np.ndarray, pitch: float, hinge_angles: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the centres `[n, 3]` and pitches `[n]` of a chain's blocks."""
    half = BLOCK_SIDE / 2
    positions, pitches = [np.asarray(root, dtype=float)], [pitch]
    for hinge, angle in zip(scene.hinges, hinge_angles, strict=True):
        edge = half if hinge.edge == "top" else -half
        axis = positions[-1] + turn(pitches[-1], half, edge)
        pitches.append(pitches[-1] + angle)
        positions.append(axis - turn(pitches[-1], -half, edge))
    return np.stack(positions), np.array(pitches)


def turn(pitch: float, x: float, z: float) -> np.ndarray:
    """Return a vector of the x-z plane, turned about y."""
    return np.array([np.cos(pitch) * x + np.sin(pitch) * z, 0.0, -np.sin(pitch) * x + np.cos(pitch) * z])
