"""Q in the scene: a coloured translucent sheet for slices of places, goals and actions, a shell of dots for turns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import trimesh
import viser
from numpy.typing import NDArray

from sldr_core.demonstrations import Landscape
from worker.viewer.inspector.colours import colours_of, shares_of

OPACITY = 0.72
"""Of the sheet: what lies behind it can be seen."""

PIXELS = 8
"""Pixels of the sheet along one side of a point's square."""

LIFT = 0.002
"""A sheet that lies on the table is lifted so much [m], so that both are not drawn in one place."""

CONTOURS = 10
"""Lines of equal value cut the range of a sheet into so many parts."""

SHELL_RADIUS = 0.075
"""The dots of a shell are so far from the object's middle [m]."""

SHELL_DOTS = 240
"""Axes that are looked at."""

SHELL_ANGLE = 0.5
"""A dot tells of a turn by so much about its axis [rad]."""

DOT_RADIUS = 0.0032
"""[m]."""

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Sheet:
    """Say where a sheet lies: its middle, its two sides, and the directions that they run in."""

    centre: Array
    """[m], `[3]`."""
    axes: tuple[int, int]
    """The scene's axes across and up."""
    size: tuple[float, float]
    """Length across and up [m]."""

    def quaternion(self) -> Array:
        """Return the rotation `[4]`, w first, that lays an upright picture (x across, y up) into the plane."""
        matrix = np.eye(4)
        across, up = np.eye(3)[list(self.axes)]
        matrix[:3, :3] = np.column_stack([across, up, np.cross(across, up)])
        return np.asarray(trimesh.transformations.quaternion_from_matrix(matrix))


def sheet_of(landscape: Landscape, place: Array, reach: float) -> Sheet:
    """Return where the sheet of a slice lies.

    Args:
        landscape: a slice of places, goals or actions.
        place: where the object, or its goal, is now [m], `[3]`; the sheet goes through it.
        reach: from the object to the tip of the arrow of a full push [m]: a sheet of actions ends there.
    """
    plane = landscape.slice
    if plane.kind == "action":
        axes = (plane.axes[0] % 3, plane.axes[1] % 3)
        return Sheet(place.copy(), axes, (2 * reach, 2 * reach))
    centre = place.copy()
    for axis, (low, high) in zip(plane.axes, (plane.across, plane.up), strict=True):
        centre[axis] = 0.5 * (low + high)
    if 2 not in plane.axes:
        centre[2] = float(place[2]) - BLOCK_HALF + LIFT
    return Sheet(centre, plane.axes, (plane.across[1] - plane.across[0], plane.up[1] - plane.up[0]))


BLOCK_HALF = 0.025
"""A sheet of places lies below the object's middle by this [m]: at its foot."""


def picture_of(value: NDArray[np.floating]) -> NDArray[np.uint8]:
    """Return values `[rows up, columns across]` as a picture with lines of equal value.

    The first row is on top: Viser draws pictures with y downwards, so that the last row lies furthest along the y axis.
    """
    smooth = enlarge(shares_of(value), PIXELS)
    level = np.floor(smooth * CONTOURS)
    line = np.zeros(level.shape, dtype=np.bool_)
    line[:-1] |= level[:-1] != level[1:]
    line[:, :-1] |= level[:, :-1] != level[:, 1:]
    colour = colours_of(smooth)
    colour[line] = (0.55 * colour[line]).astype(np.uint8)
    alpha = np.full((*smooth.shape, 1), round(255 * OPACITY), dtype=np.uint8)
    return np.concatenate([colour, alpha], axis=2)


def enlarge(values: Array, factor: int) -> Array:
    """Return values on a grid `factor` times finer, straight lines between the points, `[rows', columns']`."""
    rows = np.linspace(0, values.shape[0] - 1, factor * (values.shape[0] - 1) + 1)
    columns = np.linspace(0, values.shape[1] - 1, factor * (values.shape[1] - 1) + 1)
    tall = np.stack([np.interp(rows, np.arange(values.shape[0]), column) for column in values.T], axis=1)
    return np.stack([np.interp(columns, np.arange(values.shape[1]), row) for row in tall])


def even_directions(count: int) -> Array:
    """Return directions spread evenly over the sphere (Fibonacci's spiral), `[count, 3]`."""
    step = np.arange(count) + 0.5
    height, turn = 1.0 - 2.0 * step / count, np.pi * (1.0 + np.sqrt(5.0)) * step
    width = np.sqrt(1.0 - height**2)
    return np.column_stack([width * np.cos(turn), width * np.sin(turn), height])


class Surfaces:
    """Draw a sheet or a shell, never both."""

    directions = even_directions(SHELL_DOTS)

    def __init__(self, server: viser.ViserServer) -> None:
        self._server = server
        self._sheet: viser.ImageHandle | None = None
        self._shell: viser.BatchedMeshHandle | None = None

    def clear(self) -> None:
        """Draw nothing."""
        for node in (self._sheet, self._shell):
            if node is not None:
                node.remove()
        self._sheet = self._shell = None

    def show_sheet(self, landscape: Landscape, sheet: Sheet) -> None:
        """Draw a slice."""
        with self._server.atomic():
            picture = picture_of(landscape.value)
            if self._sheet is None:
                self.clear()
                self._sheet = self._server.scene.add_image(
                    "/q-sheet", picture, *sheet.size, format="png", cast_shadow=False, receive_shadow=False
                )
            self._sheet.image = picture
            self._sheet.render_width, self._sheet.render_height = sheet.size
            self._sheet.position, self._sheet.wxyz = sheet.centre, sheet.quaternion()

    def show_shell(self, values: NDArray[np.floating], centre: Array) -> None:
        """Draw what turning about each of `directions` is worth, around an object's middle [m], `[3]`."""
        with self._server.atomic():
            if self._shell is None:
                self.clear()
                ball = trimesh.creation.icosphere(subdivisions=1, radius=DOT_RADIUS)
                self._shell = self._server.scene.add_batched_meshes_simple(
                    "/q-shell",
                    np.asarray(ball.vertices),
                    np.asarray(ball.faces),
                    batched_wxyzs=np.tile([1.0, 0.0, 0.0, 0.0], (SHELL_DOTS, 1)),
                    batched_positions=SHELL_RADIUS * self.directions,
                    lod="off",
                    cast_shadow=False,
                    receive_shadow=False,
                )
            self._shell.batched_colors = colours_of(shares_of(values))
            self._shell.position = centre
