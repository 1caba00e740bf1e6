"""How a scene is dressed for people: what is shown, and in which colours. The physics stays as it is."""

from __future__ import annotations

import copy

import mujoco
import numpy as np
from numpy.typing import NDArray

GOAL_RGBA = (0.86, 0.03, 0.03, 0.72)
"""Translucent red."""

GOAL_RADIUS = 0.032
"""Large enough to be seen around a block that lies on it [m]."""

FLOOR_RGBA = (0.62, 0.65, 0.68, 1.0)
"""Quiet grey, on which shadows show, in a light page and in a dark one."""

BACKGROUND_RGB = (226, 232, 238)
"""The air behind the scene, in pictures."""

LAMP_DIRECTION = (-0.45, 0.35, -0.82)
"""Where the light shines to, in pictures and on the page: from beside the camera, so that shadows fall into view."""

LAMP_DISTANCE = 3.0
"""From the lamp to the middle of the room [m]."""

ROOM_CENTRE = (1.0, 0.75, 0.4)
"""The middle of what is lit [m]."""

SHADOW_REACH = 1.5
"""Shadows are cast within this of the middle [m]."""

MAX_VISIBLE_GROUP = 2
"""MuJoCo's viewers show geom groups 0 to 2 and hide the others."""

_GOAL_PREFIX = "target"
_PLAIN_RGB = 0.2
"""The dark grey of the reference's objects: as good as no colour."""
_DEFAULT_RGBA = (0.5, 0.5, 0.5, 1.0)
_OBJECT_PREFIX = "object"
_MOCAP_SUFFIX = ":mocap"
_ENDS_OF_A_PEN = (":top", ":bottom")
"""Sites in two colours: without them a pen looks the same both ways round."""


def dress(model: mujoco.MjModel) -> mujoco.MjModel:
    """Return a copy for people to look at: lit, tidied, and every plain object in the model's cube map.

    A plain cube looks the same after a quarter turn; with a letter on each side it is seen to turn.
    """
    dressed = copy.deepcopy(model)
    _light_room(dressed)
    _leave_only_the_goal_marked(dressed)
    cube_maps = np.flatnonzero(dressed.tex_type == mujoco.mjtTexture.mjTEXTURE_CUBE)
    for geom in range(dressed.ngeom):
        if not is_visible(dressed, geom):
            dressed.geom_rgba[geom, 3] = 0.0
        material = int(dressed.geom_matid[geom])
        if material < 0:
            continue
        if dressed.geom_type[geom] == mujoco.mjtGeom.mjGEOM_PLANE:
            dressed.mat_rgba[material] = FLOOR_RGBA
        elif cube_maps.size and is_object(dressed, geom) and _is_plain(dressed, material):
            dressed.mat_texid[material, mujoco.mjtTextureRole.mjTEXROLE_RGB] = cube_maps[0]
            dressed.mat_rgba[material] = 1.0
    return dressed


def is_visible(model: mujoco.MjModel, geom: int) -> bool:
    """Tell whether a geom is for people to see: not transparent, not of a hidden group, not a mocap's handle."""
    return (
        geom_rgba(model, geom)[3] > 0.0
        and int(model.geom_group[geom]) <= MAX_VISIBLE_GROUP
        and not model.body(int(model.geom_bodyid[geom])).name.endswith(_MOCAP_SUFFIX)
    )


def geom_rgba(model: mujoco.MjModel, geom: int) -> NDArray[np.float32]:
    """Return the colour MuJoCo draws a geom in: its own, or its material's where its own was left at the default."""
    own = model.geom_rgba[geom]
    material = int(model.geom_matid[geom])
    if material >= 0 and np.array_equal(own, np.asarray(_DEFAULT_RGBA, dtype=np.float32)):
        return model.mat_rgba[material].copy()
    return own.copy()


def goal_sites(model: mujoco.MjModel) -> list[int]:
    """Return the sites that mark where objects are to go, in the goal's order."""
    named = {model.site(site).name: site for site in range(model.nsite)}
    return [named[name] for index in range(model.nsite) if (name := f"{_GOAL_PREFIX}{index}") in named]


def _light_room(model: mujoco.MjModel) -> None:
    direction = np.asarray(LAMP_DIRECTION)
    model.light_castshadow[:1] = 1
    model.light_dir[:1] = direction
    # MuJoCo's shadow map is centred on the line of the lamp; off that line it is coarse and shows stripes.
    model.light_pos[:1] = np.asarray(ROOM_CENTRE) - LAMP_DISTANCE * direction
    model.light_ambient[:1], model.light_diffuse[:1], model.light_specular[:1] = 0.0, 0.6, 0.1
    model.vis.headlight.ambient[:], model.vis.headlight.diffuse[:] = 0.38, 0.24
    model.vis.headlight.specular[:] = 0.1
    model.vis.map.shadowclip = SHADOW_REACH / model.stat.extent
    model.vis.quality.shadowsize = 8192
    model.vis.quality.offsamples = 8
    for texture in np.flatnonzero(model.tex_type == mujoco.mjtTexture.mjTEXTURE_SKYBOX):
        size = int(model.tex_height[texture] * model.tex_width[texture] * model.tex_nchannel[texture])
        start = int(model.tex_adr[texture])
        model.tex_data[start : start + size].reshape(-1, 3)[:] = BACKGROUND_RGB


def _leave_only_the_goal_marked(model: mujoco.MjModel) -> None:
    """Hide every site but the goals and the ends of a pen; each of several goals keeps the colour of its object."""
    goals = goal_sites(model)
    for site in range(model.nsite):
        if site not in goals:
            if not model.site(site).name.endswith(_ENDS_OF_A_PEN):
                model.site_rgba[site, 3] = 0.0
            continue
        model.site_size[site] = GOAL_RADIUS
        if len(goals) == 1:
            model.site_rgba[site] = GOAL_RGBA
        else:
            model.site_rgba[site, 3] = GOAL_RGBA[3]


def is_object(model: mujoco.MjModel, geom: int) -> bool:
    """Tell whether a geom is part of an object that is to be moved."""
    return model.body(int(model.geom_bodyid[geom])).name.startswith(_OBJECT_PREFIX)


def _is_plain(model: mujoco.MjModel, material: int) -> bool:
    """Tell whether a material has neither a texture nor a colour of its own."""
    grey = bool((model.mat_rgba[material, :3] == np.float32(_PLAIN_RGB)).all())
    return grey and bool((model.mat_texid[material] < 0).all())
