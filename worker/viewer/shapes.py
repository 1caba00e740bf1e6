"""MuJoCo geoms as triangle meshes with MuJoCo's normals, colours and textures."""

from __future__ import annotations

import mujoco
import numpy as np
import trimesh
from numpy.typing import NDArray
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial

from worker.viewer.dress import geom_rgba
from worker.viewer.textures import CUBE_FACES, box_faces, cube_map_coordinates, find_texture, texture_image

INFINITE_PLANE = 4.0
"""Half side that stands for a plane without end [m]."""

_SECTIONS = 32
"""Sides of round things."""

_GEOM = mujoco.mjtGeom


def geom_mesh(
    model: mujoco.MjModel, geom: int, opacity: float = 1.0, tint: tuple[float, float, float] | None = None
) -> trimesh.Trimesh:
    """Return a geom as a mesh in the geom's own frame.

    Args:
        model: the scene.
        geom: which of its geoms.
        opacity: 1 for solid.
        tint: what takes the place of the geom's colour, as on a display; a texture shows through it.

    Raises:
        ValueError: the geom is of a kind that cannot be drawn.
    """
    kind = int(model.geom_type[geom])
    mesh = _mesh_asset(model, int(model.geom_dataid[geom])) if kind == _GEOM.mjGEOM_MESH else _primitive(model, geom)
    material = _material(model, geom, opacity, tint)
    uv = None
    texture = find_texture(model, geom)
    is_cube_map = texture is not None and model.tex_type[texture] == mujoco.mjtTexture.mjTEXTURE_CUBE
    if texture is not None and is_cube_map and kind == _GEOM.mjGEOM_BOX:
        uv = _box_uv(int(model.tex_width[texture]))
        material.baseColorTexture = texture_image(model, texture)
    mesh.visual = TextureVisuals(uv=uv if uv is not None else np.zeros((len(mesh.vertices), 2)), material=material)
    return mesh


def _primitive(model: mujoco.MjModel, geom: int) -> trimesh.Trimesh:
    kind, size = int(model.geom_type[geom]), np.asarray(model.geom_size[geom], dtype=np.float64)
    if kind == _GEOM.mjGEOM_BOX:
        vertices, triangles, normals = box_faces(size)
        return trimesh.Trimesh(vertices, triangles, vertex_normals=normals, process=False)
    if kind == _GEOM.mjGEOM_PLANE:
        return _plane(size)
    if kind == _GEOM.mjGEOM_SPHERE:
        return trimesh.creation.icosphere(subdivisions=3, radius=size[0])
    if kind == _GEOM.mjGEOM_ELLIPSOID:
        return trimesh.creation.icosphere(subdivisions=3).apply_scale(size)
    if kind == _GEOM.mjGEOM_CYLINDER:
        return _flat_capped(trimesh.creation.cylinder(radius=size[0], height=2 * size[1], sections=_SECTIONS))
    if kind == _GEOM.mjGEOM_CAPSULE:
        capsule = trimesh.creation.capsule(radius=size[0], height=2 * size[1], count=[_SECTIONS, _SECTIONS])
        return capsule.apply_translation(-capsule.bounds.mean(axis=0))
    raise ValueError(f"Geom {geom} ('{model.geom(geom).name}') is of kind {_GEOM(kind).name}, which is not drawn here.")


def _plane(size: NDArray[np.float64]) -> trimesh.Trimesh:
    half = np.where(size[:2] > 0, size[:2], INFINITE_PLANE)
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * half
    vertices = np.column_stack([corners, np.zeros(4)])
    normals = np.tile([0.0, 0.0, 1.0], (4, 1))
    return trimesh.Trimesh(vertices, [(0, 1, 2), (0, 2, 3)], vertex_normals=normals, process=False)


def _flat_capped(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """Split the vertices at sharp edges, so that caps are shaded flat and sides round."""
    return mesh.smooth_shaded


def _mesh_asset(model: mujoco.MjModel, mesh: int) -> trimesh.Trimesh:
    """Return a mesh asset with one vertex per pair of MuJoCo's vertex and normal."""
    vertices = _rows(model.mesh_vert, model.mesh_vertadr[mesh], model.mesh_vertnum[mesh])
    normals = _rows(model.mesh_normal, model.mesh_normaladr[mesh], model.mesh_normalnum[mesh])
    faces = _rows(model.mesh_face, model.mesh_faceadr[mesh], model.mesh_facenum[mesh])
    face_normals = _rows(model.mesh_facenormal, model.mesh_faceadr[mesh], model.mesh_facenum[mesh])
    pairs, index = np.unique(np.column_stack([faces.ravel(), face_normals.ravel()]), axis=0, return_inverse=True)
    return trimesh.Trimesh(
        vertices[pairs[:, 0]], index.reshape(-1, 3), vertex_normals=normals[pairs[:, 1]], process=False
    )


def _rows(array: NDArray, start: int, count: int) -> NDArray:
    return array[int(start) : int(start) + int(count)]


def _material(model: mujoco.MjModel, geom: int, opacity: float, tint: tuple[float, float, float] | None) -> PBRMaterial:
    rgba = geom_rgba(model, geom)
    if tint is not None:
        rgba[:3] = tint
    material = int(model.geom_matid[geom])
    gloss = float(model.mat_specular[material]) if material >= 0 else 0.0
    alpha = float(rgba[3]) * opacity
    return PBRMaterial(
        baseColorFactor=[*linear_from_srgb(rgba[:3]), alpha],
        metallicFactor=0.0,
        roughnessFactor=1.0 - 0.6 * gloss,
        alphaMode="OPAQUE" if alpha >= 1.0 else "BLEND",
    )


def linear_from_srgb(colour: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the linear light of display colours in [0, 1]: glTF wants it so, MuJoCo writes them as displayed."""
    colour = np.asarray(colour, dtype=np.float64)
    return np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4)


def _box_uv(width: int) -> NDArray[np.float64]:
    """Return texture coordinates of the 24 vertices of `box_faces`, rows counted from below as trimesh does."""
    vertices, _, _ = box_faces(np.ones(3))
    faces = vertices.reshape(CUBE_FACES, 4, 3)
    uv = np.concatenate([cube_map_coordinates(faces[face], face, width) for face in range(CUBE_FACES)])
    uv[:, 1] = 1.0 - uv[:, 1]
    return uv
