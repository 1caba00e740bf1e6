"""What the object wants, as arrows: one along the way it wants to go, one along the axis it wants to turn about."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from sldr_core.demonstrations import Wish
from sldr_core.envs.parts import OBJECT_SPEED
from worker.viewer.inspector.colours import MOVE_RGB, TURN_RGB
from worker.viewer.inspector.surfaces import ACTION_REACH

MOVE_SCALE = ACTION_REACH / float(OBJECT_SPEED)
"""Arrows of ways are so many times longer than the ways themselves."""

TURN_SCALE = 0.9
"""Length of a turn's arrow for each radian it wants in one step [m/rad]."""

SHAFT, HEAD, HEAD_LENGTH = 0.003, 0.008, 0.016
"""Radius of shaft and head, and length of the head [m]."""

SHORTEST = 1e-4
"""Arrows shorter than this are not drawn [m]."""

Array = NDArray[np.float64]


def arrow_points(centres: Array, vectors: Array) -> Array:
    """Return arrows from centres `[M, 3]` along vectors `[M, 3]`, `[M, 2, 3]`; very short ones become a dot."""
    return np.stack([centres, centres + np.where(_is_long(vectors), vectors, SHORTEST)], axis=1)


class Arrows:
    """Draw two arrows for each body that acts."""

    def __init__(self, server: viser.ViserServer) -> None:
        self._server = server
        self._nodes: list[viser.ArrowsHandle] = []

    def show(self, centres: Array, wish: Wish) -> None:
        """Draw what bodies at `centres` `[M, 3]` want."""
        points = (arrow_points(centres, MOVE_SCALE * wish.move), arrow_points(centres, TURN_SCALE * wish.turn))
        with self._server.atomic():
            if not self._nodes:
                for name, colour, arrows in zip(("move", "turn"), (MOVE_RGB, TURN_RGB), points, strict=True):
                    self._nodes.append(
                        self._server.scene.add_arrows(
                            f"/wish/{name}",
                            arrows,
                            colour,
                            shaft_radius=SHAFT,
                            head_radius=HEAD,
                            head_length=HEAD_LENGTH,
                        )
                    )
            for node, arrows in zip(self._nodes, points, strict=True):
                node.points = arrows.astype(np.float32)

    def clear(self) -> None:
        """Draw none."""
        for node in self._nodes:
            node.remove()
        self._nodes = []


def _is_long(vectors: Array) -> NDArray[np.bool_]:
    return np.linalg.norm(vectors, axis=1, keepdims=True) > SHORTEST
