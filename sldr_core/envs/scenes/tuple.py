"""The chains: FetchPickAndPlace's scene, whose block becomes the first of several, each hinged to the one before."""

from __future__ import annotations

from functools import lru_cache

import mujoco

from sldr_core.config import TupleScene
from sldr_core.envs.scenes.blocks import BLOCK_SIDE, JOINT_DAMPING, add_block, colour_blocks
from sldr_core.envs.scenes.fetch import FetchStart, build_table, settle_table
from sldr_core.envs.scenes.once import compiled_once
from sldr_core.envs.scenes.welds import load_model

__all__ = ["BLOCK_SIDE", "build_tuple", "settle_tuple"]

_EDGE_HEIGHT = {"top": BLOCK_SIDE / 2, "bottom": -BLOCK_SIDE / 2}
"""Height of a hinge's axis above a block's middle [m]."""


@compiled_once
def build_tuple(scene: TupleScene, acted: tuple[int, ...], has_robot: bool, torque_scale: float) -> mujoco.MjModel:
    """Build the scene; blocks `acted` are welded to mocap bodies."""
    spec = load_model(scene.model_file)
    block = spec.body("object0")
    for index, hinge in enumerate(scene.hinges, start=1):
        block = add_block(block, index, (BLOCK_SIDE, 0.0, 0.0))
        block.add_joint(
            name=f"object{index}:joint",
            type=mujoco.mjtJoint.mjJNT_HINGE,
            axis=[0.0, 1.0, 0.0],
            pos=[-BLOCK_SIDE / 2, 0.0, _EDGE_HEIGHT[hinge.edge]],
            limited=mujoco.mjtLimited.mjLIMITED_TRUE,
            range=[hinge.low, hinge.high],
            damping=JOINT_DAMPING,
        )
    colour_blocks(spec, scene.objects)
    return build_table(spec, acted, has_robot, torque_scale)


@lru_cache(maxsize=8)
def settle_tuple(scene: TupleScene) -> FetchStart:
    """Settle the scene with its chain lying flat."""
    return settle_table(scene, build_tuple(scene, (), True, 1.0))
