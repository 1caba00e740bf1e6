"""The bridge from a MuJoCo model to a Viser scene: one frame per body, one mesh per geom, a sphere at the goal.

`B` bodies of the model, as MuJoCo numbers them.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
import viser
from numpy.typing import ArrayLike, NDArray

from worker.viewer.dress import GOAL_RADIUS, GOAL_RGBA, GOAL_SITE, dress, is_visible
from worker.viewer.shapes import geom_mesh

REACHED_RGB = (40, 170, 80)
"""The goal's colour while the object is there."""

_GOAL_RGB = (round(255 * GOAL_RGBA[0]), round(255 * GOAL_RGBA[1]), round(255 * GOAL_RGBA[2]))


@dataclass(frozen=True)
class Poses:
    """Where every body is at one moment; the arrays are copies."""

    pos: NDArray[np.float64]
    """`[B, 3]` [m]."""
    quat: NDArray[np.float64]
    """`[B, 4]`, w first."""

    def towards(self, later: Poses, share: float) -> Poses:
        """Return the poses a share of the way to later ones; 0 is here, 1 is there."""
        sign = np.where(np.sum(self.quat * later.quat, axis=1, keepdims=True) < 0.0, -1.0, 1.0)
        quat = (1.0 - share) * self.quat + share * sign * later.quat
        return Poses((1.0 - share) * self.pos + share * later.pos, quat / np.linalg.norm(quat, axis=1, keepdims=True))


class Kinematics:
    """Compute body poses from joint positions."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model
        self._data = mujoco.MjData(model)

    def poses(self, qpos: NDArray[np.floating]) -> Poses:
        """Return where every body is at positions `[nq]`."""
        self._data.qpos[:] = qpos
        mujoco.mj_kinematics(self._model, self._data)
        return Poses(self._data.xpos.copy(), self._data.xquat.copy())


class SceneView:
    """Show one model below one node of a Viser scene; several views with different prefixes do not meet."""

    def __init__(
        self, server: viser.ViserServer, model: mujoco.MjModel, prefix: str = "/scene", opacity: float = 1.0
    ) -> None:
        self._server = server
        self.prefix = prefix
        self.model = dress(model)
        self.geom_nodes: dict[int, viser.GlbHandle] = {}
        self.body_nodes: dict[int, viser.FrameHandle] = {}
        self._shown: Poses | None = None
        with server.atomic():
            for geom in range(self.model.ngeom):
                if is_visible(self.model, geom):
                    self._add_geom(geom, opacity)
            self._goal = self._add_goal()

    def show(self, poses: Poses) -> None:
        """Move every body that has moved."""
        with self._server.atomic():
            for body, node in self.body_nodes.items():
                if self._shown is None or self._has_moved(self._shown, poses, body):
                    node.position = poses.pos[body]
                    node.wxyz = poses.quat[body]
        self._shown = poses

    def show_goal(self, position: ArrayLike, reached: bool = False) -> None:
        """Put the goal marker somewhere [m], `[3]`, in green if the object is there."""
        if self._goal is None:
            return
        with self._server.atomic():
            self._goal.position = np.asarray(position, dtype=np.float64)
            self._goal.color = REACHED_RGB if reached else _GOAL_RGB

    def _add_geom(self, geom: int, opacity: float) -> None:
        body = int(self.model.geom_bodyid[geom])
        if body not in self.body_nodes:
            self.body_nodes[body] = self._server.scene.add_frame(self._body_path(body), show_axes=False)
        self.geom_nodes[geom] = self._server.scene.add_mesh_trimesh(
            f"{self._body_path(body)}/geom{geom}",
            geom_mesh(self.model, geom, opacity),
            position=self.model.geom_pos[geom],
            wxyz=self.model.geom_quat[geom],
            cast_shadow=opacity >= 1.0 and self.model.geom_type[geom] != mujoco.mjtGeom.mjGEOM_PLANE,
        )

    def _add_goal(self) -> viser.IcosphereHandle | None:
        site = mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_SITE, GOAL_SITE)
        if site < 0:
            return None
        return self._server.scene.add_icosphere(
            f"{self.prefix}/{GOAL_SITE}",
            radius=GOAL_RADIUS,
            color=_GOAL_RGB,
            opacity=GOAL_RGBA[3],
            cast_shadow=False,
            receive_shadow=False,
        )

    def _body_path(self, body: int) -> str:
        name = self.model.body(body).name.replace("/", "_") or f"body{body}"
        return f"{self.prefix}/{name}"

    @staticmethod
    def _has_moved(before: Poses, now: Poses, body: int) -> bool:
        return not (
            np.array_equal(before.pos[body], now.pos[body]) and np.array_equal(before.quat[body], now.quat[body])
        )
