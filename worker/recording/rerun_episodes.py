"""Put one episode in 3D into a Rerun recording, on the timeline of its own steps and on that of the training."""

from __future__ import annotations

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from worker.recording.content import Arrow, Body, EpisodeScene, Form

STEP = "episode_step"
"""The timeline on which episodes play; on the training's timeline each stands at its end."""

GOAL_RADIUS = 0.02
"""Of the marker where an object is to go [m]."""
GOAL_RGBA = (219, 8, 8, 150)
PATH_RGB = (40, 40, 45)
DEMONSTRATION_RGB = (0, 158, 115)
"""Green: the way that the object would have taken by itself."""
BONE_RGB = (110, 115, 122)
THIN, THICK = 0.002, 0.008
"""Radii of lines [m]."""


def send_episode(stream: rr.RecordingStream, scene: EpisodeScene) -> None:
    """Send one episode."""
    for body in scene.bodies:
        _send_body(stream, scene, body)
    if len(scene.goals):
        goals = rr.Points3D(scene.goals, radii=GOAL_RADIUS, colors=[GOAL_RGBA])
        stream.log(f"{scene.path}/goal", goals, static=True)
    for name, way in scene.paths.items():
        stream.log(f"{scene.path}/path/{name}", rr.LineStrips3D([way], radii=THIN, colors=[PATH_RGB]), static=True)
    for name, way in scene.demonstrations.items():
        strip = rr.LineStrips3D([way], radii=THIN, colors=[DEMONSTRATION_RGB])
        stream.log(f"{scene.path}/demonstration/{name}", strip, static=True)
    for arrow in scene.arrows:
        _send_arrow(stream, scene, arrow)
    _send_bones(stream, scene)
    for name, values in scene.series.items():
        path = f"{scene.path}/series/{name}"
        stream.log(path, rr.SeriesLines(names=name), static=True)
        stream.send_columns(path, [_steps(len(values))], rr.Scalars.columns(scalars=values.astype(np.float64)))


def _send_body(stream: rr.RecordingStream, scene: EpisodeScene, body: Body) -> None:
    path = f"{scene.path}/body/{body.name}"
    for at, form in enumerate(body.forms):
        stream.log(f"{path}/{at}", _solid(form), static=True)
    quaternion = np.roll(body.quaternion, -1, axis=1)  # Rerun's have w last.
    if len(body.position) == 1:
        stream.log(path, rr.Transform3D(translation=body.position[0], quaternion=quaternion[0]), static=True)
        return
    stream.send_columns(
        path,
        [_steps(len(body.position))],
        rr.Transform3D.columns(translation=body.position, quaternion=quaternion),
    )
    stream.send_columns(
        path,
        [_end(scene)],
        rr.Transform3D.columns(translation=body.position[-1:], quaternion=quaternion[-1:]),
    )


def _solid(form: Form) -> rr.Boxes3D | rr.Ellipsoids3D | rr.Capsules3D | rr.Cylinders3D:
    w, x, y, z = form.quaternion
    turn = [[x, y, z, w]]
    colors = [[round(255 * part) for part in form.rgba]]
    look = {"colors": colors, "fill_mode": rr.components.FillMode.Solid, "quaternions": turn}
    if form.solid == "box":
        return rr.Boxes3D(half_sizes=[form.half_size], centers=[form.position], **look)
    if form.solid == "ellipsoid":
        return rr.Ellipsoids3D(half_sizes=[form.half_size], centers=[form.position], **look)
    radius, half_length, _ = form.half_size
    if form.solid == "cylinder":
        return rr.Cylinders3D(radii=[radius], lengths=[2 * half_length], centers=[form.position], **look)
    # Rerun's capsules begin at their origin, MuJoCo's have it in the middle.
    begin = np.asarray(form.position) - half_length * _z_axis(form.quaternion)
    return rr.Capsules3D(radii=[radius], lengths=[2 * half_length], translations=[begin], **look)


def _send_arrow(stream: rr.RecordingStream, scene: EpisodeScene, arrow: Arrow) -> None:
    path = f"{scene.path}/{arrow.name}"
    stream.log(path, rr.Arrows3D.from_fields(radii=THIN, colors=[arrow.rgb]), static=True)
    columns = rr.Arrows3D.columns(vectors=arrow.vector, origins=arrow.origin)
    stream.send_columns(path, [_steps(len(arrow.vector))], columns)


def _send_bones(stream: rr.RecordingStream, scene: EpisodeScene) -> None:
    count = scene.bones.shape[1]
    if not count:
        return
    path = f"{scene.path}/robot"
    stream.log(path, rr.LineStrips3D.from_fields(radii=THICK, colors=[BONE_RGB]), static=True)
    moments = len(scene.bones)
    columns = rr.LineStrips3D.columns(strips=list(scene.bones.reshape(moments * count, 2, 3)))
    stream.send_columns(path, [_steps(moments)], columns.partition([count] * moments))
    last = rr.LineStrips3D.columns(strips=list(scene.bones[-1])).partition([count])
    stream.send_columns(path, [_end(scene)], last)


def _steps(count: int) -> rr.TimeColumn:
    return rr.TimeColumn(STEP, sequence=np.arange(count))


def _end(scene: EpisodeScene) -> rr.TimeColumn:
    return rr.TimeColumn("env_steps", sequence=[scene.env_steps])


def _z_axis(quaternion: tuple[float, float, float, float]) -> NDArray[np.float64]:
    w, x, y, z = quaternion
    return np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
