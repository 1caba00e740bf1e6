"""Recorded episodes as solids, lines and arrows: MuJoCo works out where everything is, Rerun only draws.

`T` steps, `B` bodies of the model, as MuJoCo numbers them.
"""

from __future__ import annotations

from collections.abc import Mapping

import mujoco
import numpy as np
from numpy.typing import NDArray

from sldr_core.config import TrainConfig, config_from_dict
from sldr_core.envs import make_envs
from sldr_core.episodes import Origin, RecordedEpisode
from worker.recording.content import Arrow, Body, EpisodeScene, Eye, Form, Solid
from worker.viewer.camera import find_camera
from worker.viewer.dress import geom_rgba, goal_sites, is_visible

WANTED_RGB = (0, 114, 178)
"""u_t, what the object wanted: blue."""
INDUCED_RGB = (213, 94, 0)
"""w_t, what the robot made it do: vermilion; the two are told apart by colour-blind people too."""

PULL = 0.05
"""An object action of 1 pulls so far [m]."""
PART_ACTION = 7
"""Numbers of one object action: a change of position and one of a quaternion."""

EYE_NEARNESS = 0.55
"""Rerun's eye opens wider than that of our pictures, so it stands nearer."""

_ROBOT, _OBJECT, _TARGET, _MOCAP = "robot0:", "object", "target", ":mocap"
_SOLIDS: dict[int, Solid] = {
    int(mujoco.mjtGeom.mjGEOM_BOX): "box",
    int(mujoco.mjtGeom.mjGEOM_ELLIPSOID): "ellipsoid",
    int(mujoco.mjtGeom.mjGEOM_SPHERE): "ellipsoid",
    int(mujoco.mjtGeom.mjGEOM_CAPSULE): "capsule",
    int(mujoco.mjtGeom.mjGEOM_CYLINDER): "cylinder",
}
_ROBOT_RGBA = (0.55, 0.57, 0.6, 1.0)
_TABLE_RGBA = (0.78, 0.76, 0.72, 1.0)
_OBJECT_RGBA = (0.25, 0.3, 0.36, 1.0)
_TARGET_RGBA = (0.86, 0.03, 0.03, 0.45)


def load_scene(origin: Origin) -> mujoco.MjModel:
    """Build the model that a training's episodes were simulated in."""
    config = config_from_dict(dict(origin.config))
    scene = config.scene
    return make_envs(config.task, config.phase, robot=scene.locomotion_robot, variant=scene.variant).model


def make_scene(
    model: mujoco.MjModel,
    origin: Origin,
    episode: RecordedEpisode,
    demonstrations: Mapping[str, NDArray[np.float64]] | None = None,
) -> EpisodeScene:
    """Work out one episode.

    Args:
        model: the model it was simulated in.
        origin: the training that it was recorded in.
        episode: the episode.
        demonstrations: ways `[*, 3]` that objects would have taken by themselves, by object; None where unknown.
    """
    config = config_from_dict(dict(origin.config))
    pos, quat = _poses(model, episode.qpos)
    objects = {model.body(body).name: pos[:, body] for body in range(model.nbody) if _is_object(model, body)}
    name = f"epoch-{origin.epoch:04d}/{episode.index}"
    camera = find_camera(config.task_spec, config.phase)
    return EpisodeScene(
        path=f"scenes/{name}",
        title=f"Epoch {origin.epoch}, episode {episode.index}: {episode.tag.replace('_', ' ')}",
        env_steps=origin.env_steps,
        bodies=_bodies(model, pos, quat),
        bones=_bones(model, pos),
        goals=episode.goal[: 3 * len(goal_sites(model))].reshape(-1, 3),
        paths=objects,
        demonstrations=demonstrations or {},
        arrows=_arrows(config, episode, list(objects.values())),
        series=_series(origin, episode),
        eye=Eye(_three(camera.look_at + EYE_NEARNESS * (camera.position - camera.look_at)), camera.look_at),
    )


def _poses(model: mujoco.MjModel, qpos: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return where bodies are, `[T+1, B, 3]`, and how they are turned, `[T+1, B, 4]`."""
    data = mujoco.MjData(model)
    pos, quat = np.empty((len(qpos), model.nbody, 3)), np.empty((len(qpos), model.nbody, 4))
    for at, joints in enumerate(qpos):
        data.qpos[:] = joints
        mujoco.mj_kinematics(model, data)
        pos[at], quat[at] = data.xpos, data.xquat
    return pos, quat


def _bodies(model: mujoco.MjModel, pos: NDArray[np.float64], quat: NDArray[np.float64]) -> tuple[Body, ...]:
    bodies: list[Body] = []
    for body in range(model.nbody):
        forms = _forms(model, body)
        if not forms:
            continue
        is_still = bool((pos[:, body] == pos[0, body]).all() and (quat[:, body] == quat[0, body]).all())
        moments = slice(0, 1) if is_still else slice(None)
        name = model.body(body).name.removeprefix(_ROBOT).replace(" ", "-") or f"body-{body}"
        bodies.append(Body(name, forms, pos[moments, body], quat[moments, body]))
    return tuple(bodies)


def _forms(model: mujoco.MjModel, body: int) -> tuple[Form, ...]:
    """Return the solids of a body. A robot's are those that it collides with: what it shows is made of meshes."""
    name = model.body(body).name
    if name.endswith(_MOCAP):
        return ()
    geoms = range(int(model.body_geomadr[body]), int(model.body_geomadr[body]) + int(model.body_geomnum[body]))
    return tuple(
        _form(model, geom, name)
        for geom in geoms
        if int(model.geom_type[geom]) in _SOLIDS and (name.startswith(_ROBOT) or is_visible(model, geom))
    )


def _form(model: mujoco.MjModel, geom: int, name: str) -> Form:
    solid = _SOLIDS[int(model.geom_type[geom])]
    size = _three(model.geom_size[geom])
    if int(model.geom_type[geom]) == int(mujoco.mjtGeom.mjGEOM_SPHERE):
        size = (size[0], size[0], size[0])
    w, x, y, z = (float(part) for part in model.geom_quat[geom])
    return Form(solid, size, _three(model.geom_pos[geom]), (w, x, y, z), _rgba(model, geom, name))


def _rgba(model: mujoco.MjModel, geom: int, name: str) -> tuple[float, float, float, float]:
    if name.startswith(_ROBOT):
        return _ROBOT_RGBA
    if name.startswith(_TARGET):
        return _TARGET_RGBA
    if not name.startswith(_OBJECT):
        return _TABLE_RGBA
    red, green, blue, alpha = (float(part) for part in geom_rgba(model, geom))
    # Plain objects are dark grey in the model and lettered on the page; letters need textures.
    return (red, green, blue, alpha) if max(red, green, blue) - min(red, green, blue) > 0.05 else _OBJECT_RGBA


def _bones(model: mujoco.MjModel, pos: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the lines from each joint of the robot to the next, on the way to what it touches with."""
    links: list[tuple[int, int]] = []
    for body in range(model.nbody):
        if not (model.body(body).name.startswith(_ROBOT) and _forms(model, body)):
            continue
        while (parent := int(model.body_parentid[body])) > 0 and (parent, body) not in links:
            links.append((parent, body))
            body = parent
    if not links:
        return np.empty((len(pos), 0, 2, 3))
    return np.stack([pos[:, list(link)] for link in links], axis=1)


def _arrows(config: TrainConfig, episode: RecordedEpisode, objects: list[NDArray[np.float64]]) -> tuple[Arrow, ...]:
    """Return what each part wanted and was made to do, as pulls on its object."""
    parts, arrows = config.task_spec.parts, []
    for at in range(episode.wanted.shape[1]):
        pulled = objects if episode.wanted.shape[2] > PART_ACTION else [objects[parts[at].object_index]]
        # A chain is pulled at both ends.
        ends = [pulled[0], pulled[-1]] if len(pulled) > 1 else pulled
        for end, where in enumerate(ends):
            numbers = slice(PART_ACTION * end, PART_ACTION * end + 3)
            suffix = f"{parts[at].name}" if len(ends) == 1 else f"{parts[at].name}-{end}"
            for kind, actions, rgb in (
                ("wanted", episode.wanted, WANTED_RGB),
                ("induced", episode.induced, INDUCED_RGB),
            ):
                vector = PULL * actions[:, at, numbers].astype(np.float64)
                arrows.append(Arrow(f"{kind}/{suffix}", where[:-1], vector, rgb))
    return tuple(arrows)


def _series(origin: Origin, episode: RecordedEpisode) -> dict[str, NDArray[np.float32]]:
    rewards = {f"reward/{stream}": episode.reward[:, at] for at, stream in enumerate(origin.streams)}
    return rewards | {f"Q/{stream}": episode.value[:, at] for at, stream in enumerate(origin.streams)}


def _is_object(model: mujoco.MjModel, body: int) -> bool:
    name = model.body(body).name
    return name.startswith(_OBJECT) and not name.endswith(_MOCAP)


def _three(values: NDArray[np.floating]) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in values)
    return x, y, z
