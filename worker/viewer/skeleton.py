"""The bodies of a model as nodes of a Viser scene, each below the one that carries it: a turning joint is one message.

`B` bodies of the model, as MuJoCo numbers them; `S` of them are shown.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import mujoco
import numpy as np
import viser
from numpy.typing import NDArray

# Viser 1.1.1 has no public way to send many poses: its setters take 30 us each, most of it in `np.allclose`.
from viser._messages import SetOrientationMessage, SetPositionMessage

from sldr_core.envs.rotations import matrix_from_quaternion, multiply_quaternions

MOVED = 1e-5
"""Smaller changes of place are not sent [m]; they add up until they are."""

TURNED = 1e-5
"""Smaller changes of a quaternion's entry are not sent; they add up until they are."""

_CONJUGATE = np.array([1.0, -1.0, -1.0, -1.0])


@dataclass(frozen=True)
class Poses:
    """Where every body is at one moment; the arrays are copies."""

    pos: NDArray[np.float64]
    """`[B, 3]` [m]."""
    quat: NDArray[np.float64]
    """`[B, 4]`, w first."""


class Kinematics:
    """Compute body poses from joint positions."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model
        self._data = mujoco.MjData(model)
        self._between, self._way = np.zeros(model.nq), np.zeros(model.nv)

    def poses(self, qpos: NDArray[np.floating]) -> Poses:
        """Return where every body is at positions `[nq]`."""
        self._data.qpos[:] = qpos
        mujoco.mj_kinematics(self._model, self._data)
        return Poses(self._data.xpos.copy(), self._data.xquat.copy())

    def poses_between(self, qpos: NDArray[np.floating], later: NDArray[np.floating], share: float) -> Poses:
        """Return the poses a share of the way to later positions `[nq]`: 0 is here, 1 is there.

        Every joint goes its own way, the short one, so that limbs keep their lengths.
        """
        if share <= 0.0:
            return self.poses(qpos)
        self._between[:] = qpos
        mujoco.mj_differentiatePos(self._model, self._way, 1.0, self._between, np.asarray(later, dtype=np.float64))
        mujoco.mj_integratePos(self._model, self._between, self._way, share)
        return self.poses(self._between)


class Skeleton:
    """Hold a node for each body that is shown, and move those that have moved.

    Attributes:
        nodes: by body.
    """

    def __init__(self, server: viser.ViserServer, model: mujoco.MjModel, prefix: str, shown: Collection[int]) -> None:
        """Add the nodes below `prefix`, where the model's origin is."""
        self._scene = server.scene
        self.nodes: dict[int, viser.FrameHandle] = {}
        carriers: list[int] = []
        for body in sorted(shown):  # MuJoCo numbers a body after the one that carries it.
            carrier = _nearest(model, body, self.nodes)
            path = prefix if carrier is None else self.nodes[carrier].name
            self.nodes[body] = self._scene.add_frame(f"{path}/{body}", show_axes=False)
            carriers.append(carrier or 0)
        self._bodies, self._carriers = list(self.nodes), carriers
        self._pos, self._quat = np.zeros((len(self.nodes), 3)), np.tile([1.0, 0.0, 0.0, 0.0], (len(self.nodes), 1))

    def show(self, poses: Poses) -> None:
        """Move every body that has moved."""
        pos, quat = self._below_carriers(poses)
        moved = np.abs(pos - self._pos).max(axis=1) > MOVED
        turned = np.abs(quat - self._quat).max(axis=1) > TURNED
        self._pos[moved], self._quat[turned] = pos[moved], quat[turned]
        nodes = list(self.nodes.values())
        for index in np.flatnonzero(moved):
            nodes[index].position[:] = pos[index]
            self._send(SetPositionMessage(nodes[index].name, tuple(pos[index].tolist())))
        for index in np.flatnonzero(turned):
            nodes[index].wxyz[:] = quat[index]
            self._send(SetOrientationMessage(nodes[index].name, tuple(quat[index].tolist())))

    def _send(self, message: SetPositionMessage | SetOrientationMessage) -> None:
        self._scene._queue_scene_message(message)

    def _below_carriers(self, poses: Poses) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return positions `[S, 3]` and quaternions `[S, 4]` in the frames of the bodies that carry them."""
        back = poses.quat[self._carriers] * _CONJUGATE
        apart = poses.pos[self._bodies] - poses.pos[self._carriers]
        pos = np.einsum("sij,sj->si", matrix_from_quaternion(back), apart)
        return pos, multiply_quaternions(back, poses.quat[self._bodies])


def _nearest(model: mujoco.MjModel, body: int, among: Collection[int]) -> int | None:
    """Return the nearest body of some that carries a body, directly or through others; None if none of them does."""
    while body:
        body = int(model.body_parentid[body])
        if body in among:
            return body
    return None
