"""Several episodes of one scene side by side, each body drawn once for all of them: one message moves every copy."""

from __future__ import annotations

import math
from collections.abc import Sequence

import mujoco
import numpy as np
import trimesh
import viser
from numpy.typing import NDArray

from worker.viewer.dress import dress, goal_sites, is_visible
from worker.viewer.scene import GOAL_RADIUS, REACHED_RGB
from worker.viewer.shapes import geom_mesh
from worker.viewer.skeleton import Poses


def grid_offsets(count: int, spacing: tuple[float, float]) -> NDArray[np.float64]:
    """Return where `count` copies stand, in rows and columns about the first's own place [m], `[count, 3]`."""
    side = math.ceil(math.sqrt(count))
    places = np.array([(copy // side, copy % side) for copy in range(count)], dtype=np.float64)
    places -= places.mean(axis=0)
    return np.column_stack([places * spacing, np.zeros(count)])


class Crowd:
    """Show copies of one model; `N` copies."""

    def __init__(self, server: viser.ViserServer, model: mujoco.MjModel, offsets: NDArray[np.float64]) -> None:
        self._server = server
        self._offsets = offsets
        dressed = dress(model)
        still = np.tile([1.0, 0.0, 0.0, 0.0], (len(offsets), 1))
        self._bodies: dict[int, viser.BatchedGlbHandle] = {}
        with server.atomic():
            for body, scene in _body_scenes(dressed).items():
                path = f"/crowd/{body}"
                self._bodies[body] = server.scene.add_batched_glb(
                    path, _glb(scene), batched_wxyzs=still, batched_positions=offsets, lod="off"
                )
            _add_floor(server, dressed)
            self._goals = [
                [self._add_goal(dressed, site, copy) for site in goal_sites(dressed)] for copy in range(len(offsets))
            ]

    def show(self, poses: Sequence[Poses]) -> None:
        """Move every body of every copy."""
        with self._server.atomic():
            for body, node in self._bodies.items():
                positions = np.stack([each.pos[body] for each in poses]) + self._offsets
                node.batched_positions = positions.astype(np.float32)
                node.batched_wxyzs = np.stack([each.quat[body] for each in poses]).astype(np.float32)

    def show_goals(self, copy: int, positions: NDArray[np.float64], reached: bool) -> None:
        """Put the goals of one copy somewhere [m], `[goals, 3]`, in green if they are met."""
        for (node, colour), position in zip(self._goals[copy], positions, strict=False):
            node.position = position + self._offsets[copy]
            node.color = REACHED_RGB if reached else colour

    def _add_goal(
        self, model: mujoco.MjModel, site: int, copy: int
    ) -> tuple[viser.IcosphereHandle, tuple[int, int, int]]:
        red, green, blue = (round(255 * float(part)) for part in model.site_rgba[site, :3])
        path = f"/crowd/goals/{copy}/{model.site(site).name}"
        node = self._server.scene.add_icosphere(
            path, radius=GOAL_RADIUS, color=(red, green, blue), cast_shadow=False, receive_shadow=False
        )
        return node, (red, green, blue)


def _body_scenes(model: mujoco.MjModel) -> dict[int, trimesh.Scene]:
    """Return the visible geoms of every body as one scene in the body's frame; the floor is not among them."""
    scenes: dict[int, trimesh.Scene] = {}
    for geom in range(model.ngeom):
        if not is_visible(model, geom) or model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_PLANE:
            continue
        placed = np.eye(4)
        rotation = np.empty(9)
        mujoco.mju_quat2Mat(rotation, model.geom_quat[geom])
        placed[:3, :3], placed[:3, 3] = rotation.reshape(3, 3), model.geom_pos[geom]
        scene = scenes.setdefault(int(model.geom_bodyid[geom]), trimesh.Scene())
        scene.add_geometry(geom_mesh(model, geom), node_name=str(geom), geom_name=str(geom), transform=placed)
    return scenes


def _add_floor(server: viser.ViserServer, model: mujoco.MjModel) -> None:
    """Draw the floor once: copies of it would lie in one plane."""
    for geom in range(model.ngeom):
        if is_visible(model, geom) and model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_PLANE:
            server.scene.add_mesh_trimesh(
                f"/crowd/floor{geom}",
                geom_mesh(model, geom),
                scale=2.0,
                position=model.geom_pos[geom],
                cast_shadow=False,
            )


def _glb(scene: trimesh.Scene) -> bytes:
    content = scene.export(file_type="glb")
    assert isinstance(content, bytes)
    return content
