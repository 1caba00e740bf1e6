"""The mocap bodies and welds that let an object move itself."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path

import mujoco

from sldr_core.errors import BadFile

SUBSTEPS = 20
"""Physics steps of 0.002 s in one control step."""

_MOCAP_SUFFIX = ":mocap"


def object_mocap(index: int) -> str:
    """Return the name of the mocap body that moves object `index`."""
    return f"object{index}{_MOCAP_SUFFIX}"


def load_model(model_file: str) -> mujoco.MjSpec:
    """Read an MJCF file that gymnasium-robotics ships.

    Raises:
        BadFile: the package is not installed.
    """
    # Found without being imported: importing it costs a second and prints warnings about other environments.
    package = find_spec("gymnasium_robotics")
    if package is None or package.submodule_search_locations is None:
        raise BadFile(
            "The package gymnasium-robotics, which ships the scenes, is not installed; install it at the version that "
            "requirements.lock names."
        )
    path = Path(package.submodule_search_locations[0]) / "envs" / "assets" / model_file
    return mujoco.MjSpec.from_file(str(path))


def add_object_weld(spec: mujoco.MjSpec, index: int, body: str) -> None:
    """Weld a body to a new mocap body, after every weld there is."""
    mocap = object_mocap(index)
    spec.worldbody.add_body(name=mocap, mocap=True)
    weld = spec.add_equality(name=mocap, name1=mocap, name2=body)
    weld.type = mujoco.mjtEq.mjEQ_WELD
    weld.objtype = mujoco.mjtObj.mjOBJ_BODY
    weld.solref[:2] = (0.02, 1.0)
    weld.solimp[:3] = (0.9, 0.95, 0.001)


def straighten_welds(model: mujoco.MjModel, torque_scale: float) -> None:
    """Make every weld hold its two bodies in the same pose, an object's with `torque_scale`.

    The robot's weld gets the very numbers of the reference, which writes the first seven entries only: they
    are part of the physics that ours has to equal.
    """
    for weld in range(model.neq):
        name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_EQUALITY, weld) or ""
        if name.endswith(_MOCAP_SUFFIX):
            model.eq_data[weld] = (0, 0, 0, 0, 0, 0, 1, 0, 0, 0, torque_scale)
        else:
            model.eq_data[weld, :7] = (0, 0, 0, 0, 0, 0, 1)


def remove_bodies(spec: mujoco.MjSpec, prefix: str) -> None:
    """Take bodies out of the world, and with them all that refers to them."""
    names: Sequence[mujoco.MjsBody] = [body for body in spec.worldbody.bodies if body.name.startswith(prefix)]
    for body in names:
        spec.delete(body)
