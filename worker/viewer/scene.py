"""The bridge from a MuJoCo model to a Viser scene: one frame per body, one mesh per geom, a sphere at each goal."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
import viser
from numpy.typing import ArrayLike

from worker.viewer.dress import GOAL_RADIUS, GOAL_RGBA, dress, goal_sites, is_object, is_visible
from worker.viewer.shapes import geom_mesh
from worker.viewer.skeleton import Poses, Skeleton

REACHED_RGB = (40, 170, 80)
"""The goal's colour while the object is there."""

Rgb = tuple[int, int, int]


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
        geoms = [
            geom
            for geom in range(model.ngeom)
            if is_visible(self.model, geom) and (not look.objects_only or is_object(self.model, geom))
        ]
        self._marked: tuple[object, bool] | None = None
        with server.atomic():
            self.root = server.scene.add_frame(prefix, show_axes=False, position=look.offset)
            self.skeleton = Skeleton(server, model, prefix, {int(model.geom_bodyid[geom]) for geom in geoms})
            self.geom_nodes = {geom: self._add_geom(geom, look) for geom in geoms}
            self._goals = [] if look.objects_only else [self._add_goal(site) for site in goal_sites(self.model)]

    def show(self, poses: Poses) -> None:
        """Move every body that has moved."""
        with self._server.atomic():
            self.skeleton.show(poses)

    def show_goals(self, positions: ArrayLike, reached: bool = False) -> None:
        """Put the goal markers somewhere [m], `[goals, 3]`, in green if the objects are there."""
        places = np.reshape(np.asarray(positions, dtype=np.float64), (-1, 3))
        marked = (places.tolist(), reached)
        if marked == self._marked:
            return
        self._marked = marked
        with self._server.atomic():
            for (node, colour), position in zip(self._goals, places, strict=False):
                node.position = position
                node.color = REACHED_RGB if reached else colour

    def _add_geom(self, geom: int, look: Look) -> viser.GlbHandle:
        body = self.skeleton.nodes[int(self.model.geom_bodyid[geom])]
        return self._server.scene.add_mesh_trimesh(
            f"{body.name}/geom{geom}",
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
