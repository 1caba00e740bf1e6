"""The spaces of starts and goals that maps are drawn over, as each family's tasks draw them.

Lengths are shown in centimetres, angles in degrees.
"""

from __future__ import annotations

from functools import partial
from itertools import pairwise

import mujoco
import numpy as np
from numpy.typing import NDArray

from sldr_core.config import FetchScene, HandScene, PoseGoal, StackScene, TableScene, TaskSpec, TupleScene
from sldr_core.demonstrations.coverage import Axis, Coordinates, Space
from sldr_core.demonstrations.placing import joint_pose
from sldr_core.envs import Start
from sldr_core.envs.rewards import goal_offsets
from sldr_core.envs.rotations import rotation_vector, turn_between
from sldr_core.envs.scenes.fetch import FetchStart, settle_fetch
from sldr_core.envs.scenes.stack import settle_stack
from sldr_core.envs.scenes.tuple import settle_tuple

CELLS = 10
"""Cells along one side of a map."""

TURN_CELLS = 12
"""Cells between no turn and half a turn."""

HEIGHT_CELLS = 3
"""Layers of goals above the hand."""

CM_PER_M = 100.0

HEIGHTS_CM = (1.0, 15.0, 30.0, 45.0)
"""Layers of goals above the table end at these heights [cm]."""

Array = NDArray[np.float64]
Numbers = NDArray[np.int64]

_ONE_LAYER = Axis("", "", (0.0, 1.0))
_DIRECTIONS = ("+x", "-x", "+y", "-y", "+z", "-z")


def spaces_of(task: TaskSpec, model: mujoco.MjModel) -> tuple[Space, ...]:
    """Return the spaces of a task whose starts are those of `model`, the scene of the object alone."""
    pose = joint_pose(model, 0)
    if isinstance(task.scene, HandScene):
        return _hand_spaces(task, task.scene, pose)
    scene, start = task.scene, _settled(task.scene)
    shift = scene.start_shift if isinstance(scene, TupleScene) else 0.0
    offset = scene.target_offset if isinstance(scene, FetchScene) else (0.0, 0.0, 0.0)
    layer, coordinates = _goal_layers(scene, start.object_height)
    goals = Space(
        "goal",
        "where the goal is",
        _around(start, "goal x", 0, scene.target_range, offset[0]),
        _around(start, "goal y", 1, scene.target_range, offset[1]),
        layer,
        coordinates,
    )
    starts = Space(
        "start",
        "where the object starts",
        _around(start, "start x", 0, scene.object_range, shift),
        _around(start, "start y", 1, scene.object_range, 0.0),
        _ONE_LAYER,
        lambda start, numbers: _columns(CM_PER_M * start.qpos[:, pose][:, :2], np.zeros(len(start.qpos))),
    )
    return goals, starts


def _settled(scene: TableScene) -> FetchStart:
    if isinstance(scene, TupleScene):
        return settle_tuple(scene)
    if isinstance(scene, StackScene):
        return settle_stack(scene)
    assert isinstance(scene, FetchScene)
    return settle_fetch(scene)


def _around(start: FetchStart, name: str, axis: int, reach: float, offset: float) -> Axis:
    centre = start.gripper_pos[axis] + offset
    return Axis(name, "cm", _edges(CM_PER_M * (centre - reach), CM_PER_M * (centre + reach), CELLS))


def _goal_layers(scene: TableScene, table: float) -> tuple[Axis, Coordinates]:
    """Return the layers that goals on a table lie in, and their coordinates."""
    if isinstance(scene, TupleScene):
        shapes = np.array([[(x, 0.0, z) for x, z in shape.offsets] for shape in scene.shapes])
        return _named("shape", tuple(shape.name for shape in scene.shapes)), partial(_shape_places, shapes)
    if isinstance(scene, StackScene):
        names = tuple(f"block {index + 1}" for index in range(scene.objects))
        return _named("block", names), partial(_block_places, scene.objects)
    if isinstance(scene, FetchScene) and scene.target_in_the_air:
        edges = (-HEIGHTS_CM[0], *HEIGHTS_CM)
        names = ("on the table", *(f"{low:g} to {high:g} cm up" for low, high in pairwise(HEIGHTS_CM)))
        return Axis("height", "", edges, names), partial(_air_places, table)
    return _ONE_LAYER, lambda start, numbers: _columns(CM_PER_M * start.goal[:, :2], np.zeros(len(start.goal)))


def _shape_places(shapes: Array, start: Start, numbers: Numbers) -> Array:
    """Return the base points of chains' goals, and in which of `shapes` `[S, n, 3]` they are."""
    blocks = start.goal.reshape(len(start.goal), 1, -1, 3)
    apart = (blocks - blocks[:, :, :1]) - (shapes - shapes[:, :1])
    nearest = np.square(apart).sum(axis=(2, 3)).argmin(axis=1)
    return _columns(CM_PER_M * (start.goal[:, :3] - shapes[nearest, 0])[:, :2], nearest)


def _block_places(blocks: int, start: Start, numbers: Numbers) -> Array:
    return _columns(CM_PER_M * start.goal[:, :2], numbers % blocks)


def _air_places(table: float, start: Start, numbers: Numbers) -> Array:
    return _columns(CM_PER_M * start.goal[:, :2], CM_PER_M * (start.goal[:, 2] - table))


def _hand_spaces(task: TaskSpec, scene: HandScene, pose: slice) -> tuple[Space, ...]:
    spaces: list[Space] = []
    assert isinstance(task.goal, PoseGoal)
    if task.goal.angle is not None:
        spaces.append(
            Space(
                "turn",
                "how far the goal is turned from the start, and about which axis",
                Axis("angle", "°", _edges(0.0, 180.0, TURN_CELLS)),
                _named("axis", _DIRECTIONS),
                _ONE_LAYER,
                partial(_turns, task, pose),
            )
        )
    if task.goal.distance is not None:
        x, y, z = ((CM_PER_M * low, CM_PER_M * high) for low, high in scene.target_range)
        heights = _edges(*z, HEIGHT_CELLS)
        names = tuple(f"{low:g} to {high:g} cm up" for low, high in pairwise(heights))
        spaces.append(
            Space(
                "way",
                "how far the goal is from the start",
                Axis("way in x", "cm", _edges(*x, CELLS)),
                Axis("way in y", "cm", _edges(*y, CELLS)),
                Axis("height", "", heights, names),
                lambda start, numbers: CM_PER_M * (start.goal[:, :3] - start.qpos[:, pose][:, :3]),
            )
        )
    return tuple(spaces)


def _turns(task: TaskSpec, pose: slice, start: Start, numbers: Numbers) -> Array:
    """Return the angle [°] that is scored between start and goal, and the direction that is nearest to its axis."""
    lies = start.qpos[:, pose]
    angle = np.degrees(goal_offsets(task.goal, lies, start.goal).angle)
    axis = rotation_vector(turn_between(lies[:, 3:], start.goal[:, 3:]))
    nearest = np.abs(axis).argmax(axis=1)
    backwards = np.take_along_axis(axis, nearest[:, None], axis=1)[:, 0] < 0.0
    return np.column_stack([angle, 2 * nearest + backwards, np.zeros(len(angle))])


def _named(name: str, cells: tuple[str, ...]) -> Axis:
    """Return an axis of things that have names: cell `i` holds the number `i`."""
    return Axis(name, "", _edges(-0.5, len(cells) - 0.5, len(cells)), cells)


def _columns(xy: Array, layer: NDArray) -> Array:
    return np.column_stack([xy, layer])


def _edges(low: float, high: float, cells: int) -> tuple[float, ...]:
    return tuple(np.linspace(low, high, cells + 1).tolist())
