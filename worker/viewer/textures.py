"""Texture images out of a MuJoCo model, and where a box's faces lie on a cube map.

MuJoCo stores a cube map as six square faces, one above the other, in the order +x, -x, +y, -y, +z, -z
and looks it up by the direction from the box's centre, as OpenGL does.
"""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray
from PIL import Image

CUBE_FACES = 6

_BLEED = 1.0
"""Faces are cut this much inside their border, so that smoothing never mixes neighbours [pixels]."""

# For each face, outward normal first: the axis and sign of the direction along which the image's columns
# and rows grow (OpenGL 4.6 core, table 8.19).
_FACE_AXES: tuple[tuple[tuple[int, int], tuple[int, int], tuple[int, int]], ...] = (
    ((0, 1), (2, -1), (1, -1)),
    ((0, -1), (2, 1), (1, -1)),
    ((1, 1), (0, 1), (2, 1)),
    ((1, -1), (0, 1), (2, -1)),
    ((2, 1), (0, 1), (1, -1)),
    ((2, -1), (0, -1), (1, -1)),
)


def find_texture(model: mujoco.MjModel, geom: int) -> int | None:
    """Return the texture that colours a geom, if there is one."""
    material = int(model.geom_matid[geom])
    if material < 0:
        return None
    texture = int(model.mat_texid[material, mujoco.mjtTextureRole.mjTEXROLE_RGB])
    return texture if texture >= 0 else None


def texture_image(model: mujoco.MjModel, texture: int) -> Image.Image:
    """Return a texture as a picture, a cube map as its six faces one above the other."""
    height, width = int(model.tex_height[texture]), int(model.tex_width[texture])
    channels = int(model.tex_nchannel[texture])
    start = int(model.tex_adr[texture])
    pixels = model.tex_data[start : start + height * width * channels].reshape(height, width, channels)
    return Image.fromarray(np.ascontiguousarray(pixels[..., :3]), "RGB")


def cube_map_coordinates(direction: NDArray[np.float64], face: int, width: int) -> NDArray[np.float64]:
    """Return where directions out of a box's centre lie on the stacked picture, `[..., 2]`: column, row in [0, 1].

    Args:
        direction: points of the face of a box with half sides of 1, `[..., 3]`.
        face: which face they lie on, 0 to 5.
        width: pixels along one side of a face.
    """
    _, (column_axis, column_sign), (row_axis, row_sign) = _FACE_AXES[face]
    inner = 1.0 - 2.0 * _BLEED / width
    column = 0.5 + 0.5 * inner * column_sign * direction[..., column_axis]
    row = 0.5 + 0.5 * inner * row_sign * direction[..., row_axis]
    return np.stack([column, (face + row) / CUBE_FACES], axis=-1)


def box_faces(size: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.float64]]:
    """Return a box whose faces share no vertex: vertices `[24, 3]`, triangles `[12, 3]`, normals `[24, 3]`.

    Args:
        size: half sides [m], `[3]`. Four vertices after one another make a face, in the cube map's order.
    """
    corners, normals, triangles = [], [], []
    for face, ((axis, sign), (column_axis, _), (row_axis, _)) in enumerate(_FACE_AXES):
        normal = np.zeros(3)
        normal[axis] = sign
        quad = np.repeat(normal[None], 4, axis=0)
        quad[:, column_axis] = (-1, 1, 1, -1)
        quad[:, row_axis] = (-1, -1, 1, 1)
        order = [(0, 1, 2), (0, 2, 3)]
        if np.dot(np.cross(quad[1] - quad[0], quad[2] - quad[0]), normal) < 0:
            order = [(0, 2, 1), (0, 3, 2)]
        corners.append(quad)
        normals.append(np.repeat(normal[None], 4, axis=0))
        triangles.extend([[4 * face + corner for corner in triangle] for triangle in order])
    return np.concatenate(corners) * size, np.asarray(triangles), np.concatenate(normals)
