"""The cube map on a box: ours against OpenGL's rule, written out by hand, and against MuJoCo's own picture."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import mujoco
import numpy as np
import pytest
from trimesh.visual import TextureVisuals

from worker.viewer.shapes import geom_mesh
from worker.viewer.textures import box_faces, cube_map_coordinates, texture_image

# One column per pixel quarter: every face has four colours of its own, so that turns and mirrors are seen.
FACE_PIXELS = 64
QUARTERS = (0, 60, 120, 180)


def cube_image() -> np.ndarray:
    faces = np.zeros((6, FACE_PIXELS, FACE_PIXELS, 3), dtype=np.uint8)
    half = FACE_PIXELS // 2
    for face in range(6):
        for quarter, (row, column) in enumerate([(0, 0), (0, half), (half, 0), (half, half)]):
            faces[face, row : row + half, column : column + half] = (40 * face + 40, 40 + QUARTERS[quarter], 128)
    return faces.reshape(6 * FACE_PIXELS, FACE_PIXELS, 3)


def box_model() -> mujoco.MjModel:
    spec = mujoco.MjSpec()
    texture = spec.add_texture(name="cube", type=mujoco.mjtTexture.mjTEXTURE_CUBE, nchannel=3)
    texture.width, texture.height, texture.data = FACE_PIXELS, 6 * FACE_PIXELS, cube_image().tobytes()
    material = spec.add_material(name="cube")
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = "cube"
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.1, 0.1, 0.1], material="cube")
    return spec.compile()


def opengl_lookup(direction: np.ndarray) -> tuple[int, float, float]:
    """Return face, s and t of OpenGL 4.6 core, table 8.19, case by case."""
    x, y, z = direction
    ax, ay, az = np.abs(direction)
    if ax >= ay and ax >= az:
        face, sc, tc, ma = (0, -z, -y, ax) if x > 0 else (1, z, -y, ax)
    elif ay >= az:
        face, sc, tc, ma = (2, x, z, ay) if y > 0 else (3, x, -z, ay)
    else:
        face, sc, tc, ma = (4, x, -y, az) if z > 0 else (5, -x, -y, az)
    return face, 0.5 * (sc / ma + 1), 0.5 * (tc / ma + 1)


def test_box_points_fall_where_opengl_looks_them_up():
    vertices, triangles, _ = box_faces(np.ones(3))
    for face in range(6):
        for triangle in triangles[2 * face : 2 * face + 2]:
            point = vertices[triangle].mean(axis=0)
            expected_face, s, t = opengl_lookup(point)
            column, row = cube_map_coordinates(point, face, 10**6)
            assert face == expected_face
            assert column == pytest.approx(s, abs=1e-5)
            assert 6 * row - face == pytest.approx(t, abs=1e-5)


def test_box_triangles_face_outwards():
    vertices, triangles, normals = box_faces(np.array([0.1, 0.2, 0.3]))
    for triangle in triangles:
        a, b, c = vertices[triangle]
        assert np.cross(b - a, c - a) @ normals[triangle[0]] > 0


def test_faces_of_a_box_share_no_vertex():
    vertices, triangles, _ = box_faces(np.ones(3))
    assert len(vertices) == 24
    assert not set(triangles[:2].ravel()) & set(triangles[2:].ravel())


def test_texture_image_is_the_stacked_cube_map():
    assert np.array_equal(np.asarray(texture_image(box_model(), 0)), cube_image())


DRAW = """
import json, sys
import mujoco, numpy as np
sys.path.insert(0, sys.argv[1])
from test_viewer_textures import box_model
model = box_model()
model.vis.headlight.ambient[:], model.vis.headlight.diffuse[:], model.vis.headlight.specular[:] = 1, 0, 0
model.vis.global_.offwidth = model.vis.global_.offheight = 64
data = mujoco.MjData(model); mujoco.mj_forward(model, data)
renderer = mujoco.Renderer(model, 64, 64)
seen = []
for point in json.loads(sys.argv[2]):
    camera = mujoco.MjvCamera()
    direction = -np.asarray(point) / np.linalg.norm(point)
    camera.lookat[:] = 0.1 * np.asarray(point)
    camera.distance = 0.15
    camera.azimuth = np.degrees(np.arctan2(direction[1], direction[0]))
    camera.elevation = np.degrees(np.arcsin(direction[2]))
    renderer.update_scene(data, camera)
    seen.append(renderer.render()[32, 32].tolist())
print(json.dumps(seen))
"""


def test_every_quarter_of_every_face_has_the_colour_that_mujoco_draws_there():
    mesh = geom_mesh(box_model(), 0)
    points, ours = [], []
    picture = np.asarray(texture_image(box_model(), 0))
    vertices = np.asarray(mesh.vertices).reshape(6, 4, 3) / 0.1
    assert isinstance(mesh.visual, TextureVisuals)
    uv = np.asarray(mesh.visual.uv).reshape(6, 4, 2)
    for face in range(6):
        for corner in range(4):
            # A point in the quarter of that corner, by the same weights on the vertices and on their coordinates.
            weights = np.full(4, 0.125)
            weights[corner] = 0.625
            points.append((weights @ vertices[face]).tolist())
            column, up = weights @ uv[face]
            ours.append(picture[int((1 - up) * 6 * FACE_PIXELS), int(column * FACE_PIXELS)].tolist())
    command = [sys.executable, "-c", DRAW, os.path.dirname(__file__), json.dumps(points)]
    done = subprocess.run(command, env={**os.environ, "MUJOCO_GL": "egl"}, capture_output=True, text=True, check=True)
    drawn = json.loads(done.stdout.splitlines()[-1])
    assert np.abs(np.asarray(drawn) - np.asarray(ours)).max() <= 3
    assert len({tuple(colour) for colour in ours}) == 24
