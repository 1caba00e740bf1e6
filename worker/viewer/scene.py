"""The bridge from a MuJoCo model to a Viser scene: one frame per body, one mesh per geom, a sphere at each goal.

`B` bodies of the model, as MuJoCo numbers them.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
import viser
from numpy.typing import ArrayLike, NDArray

from worker.viewer.dress import GOAL_RADIUS, GOAL_RGBA, dress, goal_sites, is_object, is_visible
from worker.viewer.shapes import geom_mesh

REACHED_RGB = (40, 170, 80)
"""The goal's colour while the object is there."""

Rgb = tuple[int, int, int]


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


@dataclass(frozen=True)
class Look:
    """Say how a model is drawn."""

    opacity: float = 1.0
    """1 for solid; what is translucent casts no shadow."""
    tint: tuple[float, float, float] | None = None
    """What takes the place of the colours, in [0, 1]."""
    objects_only: bool = False
    """Whether only the objects are drawn: no robot, no table, no goals."""
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Where the model's origin is put [m]."""


SOLID = Look()
"""The whole model as it is."""


class SceneView:
    """Show one model below one node of a Viser scene; several views with different prefixes do not meet."""

    def __init__(
        self, server: viser.ViserServer, model: mujoco.MjModel, prefix: str = "/scene", look: Look = SOLID
    ) -> None:
        self._server = server
        self.prefix = prefix
        self.model = dress(model)
        self.geom_nodes: dict[int, viser.GlbHandle] = {}
        self.body_nodes: dict[int, viser.FrameHandle] = {}
        self._shown: Poses | None = None
        with server.atomic():
            self.root = server.scene.add_frame(prefix, show_axes=False, position=look.offset)
            for geom in range(self.model.ngeom):
                if is_visible(self.model, geom) and (not look.objects_only or is_object(self.model, geom)):
                    self._add_geom(geom, look)
            self._goals = [] if look.objects_only else [self._add_goal(site) for site in goal_sites(self.model)]

    def show(self, poses: Poses) -> None:
        """Move every body that has moved."""
        shown = self._shown
        moved, turned = np.ones((2, len(poses.pos)), dtype=np.bool_)
        if shown is not None:
            moved, turned = (shown.pos != poses.pos).any(axis=1), (shown.quat != poses.quat).any(axis=1)
        with self._server.atomic():
            for body, node in self.body_nodes.items():
                if moved[body]:
                    node.position = poses.pos[body]
                if turned[body]:
                    node.wxyz = poses.quat[body]
        self._shown = poses

    def show_goals(self, positions: ArrayLike, reached: bool = False) -> None:
        """Put the goal markers somewhere [m], `[goals, 3]`, in green if the objects are there."""
        with self._server.atomic():
            for (node, colour), position in zip(self._goals, np.reshape(positions, (-1, 3)), strict=False):
                node.position = np.asarray(position, dtype=np.float64)
                node.color = REACHED_RGB if reached else colour

    def _add_geom(self, geom: int, look: Look) -> None:
        body = int(self.model.geom_bodyid[geom])
        if body not in self.body_nodes:
            self.body_nodes[body] = self._server.scene.add_frame(self._body_path(body), show_axes=False)
        self.geom_nodes[geom] = self._server.scene.add_mesh_trimesh(
            f"{self._body_path(body)}/geom{geom}",
            geom_mesh(self.model, geom, look.opacity, look.tint),
            position=self.model.geom_pos[geom],
            wxyz=self.model.geom_quat[geom],
            cast_shadow=look.opacity >= 1.0 and self.model.geom_type[geom] != mujoco.mjtGeom.mjGEOM_PLANE,
        )

    def _add_goal(self, site: int) -> tuple[viser.IcosphereHandle, Rgb]:
        red, green, blue = (round(255 * float(part)) for part in self.model.site_rgba[site, :3])
        node = self._server.scene.add_icosphere(
            f"{self.prefix}/{self.model.site(site).name}",
            radius=GOAL_RADIUS,
            color=(red, green, blue),
            opacity=GOAL_RGBA[3],
            cast_shadow=False,
            receive_shadow=False,
        )
        return node, (red, green, blue)

    def _body_path(self, body: int) -> str:
        name = self.model.body(body).name.replace("/", "_") or f"body{body}"
        return f"{self.prefix}/{name}"
