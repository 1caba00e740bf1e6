"""The blocks that stacks and chains are made of: FetchPickAndPlace's block, each in a colour of its own."""

from __future__ import annotations

import mujoco

BLOCK_SIDE = 0.05
"""Side of a block [m]."""

BLOCK_MASS = 2.0
"""[kg]."""

JOINT_DAMPING = 0.01
"""Of free joints and hinges, as the reference's block has it."""

MARKER_RADIUS = 0.02
"""Radius of the sites that mark blocks and goals [m]."""

BLOCK_COLOURS = (
    (0.85, 0.33, 0.24, 1.0),
    (0.22, 0.53, 0.82, 1.0),
    (0.95, 0.72, 0.20, 1.0),
    (0.36, 0.66, 0.40, 1.0),
    (0.56, 0.40, 0.72, 1.0),
)
"""A block's colour and that of its goal, by number."""

_FLOOR_BODY = "floor0"


def add_block(parent: mujoco.MjsBody, index: int, position: tuple[float, float, float]) -> mujoco.MjsBody:
    """Add block `index` below a body, without a joint; its first geom and its site have the body's name."""
    name = f"object{index}"
    half = [BLOCK_SIDE / 2] * 3
    block = parent.add_body(name=name, pos=position)
    block.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_BOX, size=half, mass=BLOCK_MASS, condim=3)
    block.add_site(name=name, size=[MARKER_RADIUS] * 3)
    return block


def colour_blocks(spec: mujoco.MjSpec, blocks: int) -> None:
    """Give each block a material of its own colour, and each goal a site `target0`, `target1`, ... in it."""
    floor = spec.body(_FLOOR_BODY)
    for index in range(blocks):
        name, colour = f"object{index}", BLOCK_COLOURS[index % len(BLOCK_COLOURS)]
        spec.add_material(name=name, rgba=colour, specular=0.0)
        spec.geom(name).material = name
        if index > 0:
            # Not at the body's own origin: MuJoCo would take it for fixed there, wherever it is put later.
            floor.add_site(name=f"target{index}", size=[MARKER_RADIUS] * 3, pos=[0.0, 0.1 * index, 0.5])
        spec.site(f"target{index}").rgba = colour
