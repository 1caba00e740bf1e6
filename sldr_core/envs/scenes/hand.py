"""The scenes of the Shadow hand: the reference's own models, with what object locomotion adds."""

from __future__ import annotations

import copy

import mujoco

from sldr_core.config import HandScene
from sldr_core.envs.scenes.once import compiled_once
from sldr_core.envs.scenes.welds import add_object_weld, load_model, straighten_welds

OBJECT = "object"
"""The body in the hand; its joint is `object:joint`."""

TARGET = "target"
"""The body that shows the goal; nothing touches it."""


@compiled_once
def build_hand(scene: HandScene, object_acts: bool, torque_scale: float) -> mujoco.MjModel:
    """Build the reference's scene, with a mocap body welded to the object if that acts.

    The target is spared gravity, so that it stays where it is put: in the reference it falls for ever, which
    nothing else feels.
    """
    spec = load_model(scene.model_file)
    spec.body(TARGET).gravcomp = 1.0
    if object_acts:
        add_object_weld(spec, 0, OBJECT)
    model = spec.compile()
    straighten_welds(model, torque_scale)
    return model


def without_welds(model: mujoco.MjModel) -> mujoco.MjModel:
    """Return a copy in which no weld pulls."""
    free = copy.copy(model)
    free.eq_active0[:] = 0
    return free
