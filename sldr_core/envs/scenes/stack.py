"""The stacking scenes: FetchPickAndPlace's table with a low wall around it and more blocks."""

from __future__ import annotations

from functools import lru_cache

import mujoco

from sldr_core.config import StackScene
from sldr_core.envs.scenes.blocks import JOINT_DAMPING, add_block, colour_blocks
from sldr_core.envs.scenes.fetch import FetchStart, build_table, settle_table
from sldr_core.envs.scenes.once import compiled_once
from sldr_core.envs.scenes.welds import load_model

WALL_HALF_THICKNESS = 0.01
"""Half the thickness of the wall, whose middle stands on the table's edge [m]."""

SETTLING_DISTANCE = 0.1
"""From one block to the next while the scene settles [m]."""


@compiled_once
def build_stack(scene: StackScene, has_robot: bool = True) -> mujoco.MjModel:
    """Build the scene with its robot, as nothing else acts in it, or without, to be looked at."""
    spec = load_model(scene.model_file)
    _add_wall(spec, scene.wall_half_height)
    x, y, z = scene.start_object
    for index in range(1, scene.objects):
        block = add_block(spec.worldbody, index, (x, y + SETTLING_DISTANCE * index, z))
        block.add_joint(name=f"object{index}:joint", type=mujoco.mjtJoint.mjJNT_FREE, damping=JOINT_DAMPING)
    colour_blocks(spec, scene.objects)
    return build_table(spec, (), has_robot, 1.0)


@lru_cache(maxsize=8)
def settle_stack(scene: StackScene) -> FetchStart:
    """Settle the scene with all its blocks."""
    return settle_table(scene, build_stack(scene))


def _add_wall(spec: mujoco.MjSpec, half_height: float) -> None:
    """Put four boards on the edges of the table's top, half above it and half below."""
    table = spec.body("table0")
    top = table.geoms[0]
    half_x, half_y, half_z = (float(half) for half in top.size)
    boards = (
        ((0.0, half_y), (half_x + WALL_HALF_THICKNESS, WALL_HALF_THICKNESS)),
        ((0.0, -half_y), (half_x + WALL_HALF_THICKNESS, WALL_HALF_THICKNESS)),
        ((half_x, 0.0), (WALL_HALF_THICKNESS, half_y)),
        ((-half_x, 0.0), (WALL_HALF_THICKNESS, half_y)),
    )
    for number, ((x, y), (board_x, board_y)) in enumerate(boards):
        table.add_geom(
            name=f"wall{number}",
            type=mujoco.mjtGeom.mjGEOM_BOX,
            pos=[x, y, half_z],
            size=[board_x, board_y, half_height],
            material=top.material,
        )
