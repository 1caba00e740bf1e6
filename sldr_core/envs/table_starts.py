"""Where episodes on a table start, and what they are to reach (facts of the reference and of the paper's tasks)."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np

from sldr_core.config import FetchScene, StackScene, TableScene, TupleScene
from sldr_core.envs.parts import Start, stack_starts
from sldr_core.envs.scenes.fetch import FetchStart
from sldr_core.envs.simulation import Array

MIN_GRIPPER_DISTANCE = 0.1
"""An object never starts nearer to the gripper than this, in the plane [m]."""

AIR_PROBABILITY = 0.5
"""Share of goals above the table, where the task has such goals."""

MAX_AIR_HEIGHT = 0.45
"""Highest goal above the table [m]."""

_POSE = 7


class _TableStarts:
    """Lay objects around the gripper's start; what is drawn is up to the family."""

    def __init__(self, scene: TableScene, start: FetchStart, model: mujoco.MjModel) -> None:
        self._scene = scene
        self._gripper = start.gripper_pos
        self._height = start.object_height
        has_robot = model.nq == start.qpos.size
        self._qpos = start.qpos if has_robot else start.object_qpos
        self._qvel = start.qvel if has_robot else np.zeros(model.nv)
        self._first = int(model.joint("object0:joint").qposadr[0])

    def draw(self, rngs: Sequence[np.random.Generator]) -> Start:
        """Draw the starts of `N` episodes."""
        return stack_starts([self._draw_one(rng) for rng in rngs])

    def _draw_one(self, rng: np.random.Generator) -> Start:
        raise NotImplementedError

    def _start(self, places: Sequence[Array], goal: Array) -> Start:
        """Return the settled scene with its free objects moved to `places` in the plane [m]."""
        qpos = self._qpos.copy()
        for index, place in enumerate(places):
            first = self._first + _POSE * index
            qpos[first : first + 2] = place
        return Start(qpos=qpos, qvel=self._qvel, goal=goal)

    def _draw_place(self, rng: np.random.Generator, shift: float = 0.0) -> Array:
        """Draw x and y [m] around the gripper, not under it, with `shift` added to x."""
        reach = self._scene.object_range
        while True:
            offset = rng.uniform(-reach, reach, size=2)
            offset[0] += shift
            if np.hypot(offset[0], offset[1]) >= MIN_GRIPPER_DISTANCE:
                return self._gripper[:2] + offset

    def _draw_target(self, rng: np.random.Generator) -> Array:
        """Draw a point on the table around the gripper [m], `[3]`."""
        reach = self._scene.target_range
        target = self._gripper + rng.uniform(-reach, reach, size=3)
        target[2] = self._height
        return target


class FetchStarts(_TableStarts):
    """Draw one object and one goal, as the reference does."""

    def __init__(self, scene: FetchScene, start: FetchStart, model: mujoco.MjModel) -> None:
        super().__init__(scene, start, model)
        self._offset = np.array([scene.target_offset[0], scene.target_offset[1], 0.0])
        self._in_the_air = scene.target_in_the_air

    def _draw_one(self, rng: np.random.Generator) -> Start:
        place = self._draw_place(rng)
        goal = self._draw_target(rng) + self._offset
        if self._in_the_air and rng.uniform() < AIR_PROBABILITY:
            goal[2] += rng.uniform(0.0, MAX_AIR_HEIGHT)
        return self._start([place], goal)


class StackStarts(_TableStarts):
    """Draw blocks that lie apart; goals are a tower where the first block starts, or places on the table."""

    def __init__(self, scene: StackScene, start: FetchStart, model: mujoco.MjModel, tower_probability: float) -> None:
        super().__init__(scene, start, model)
        self._objects = scene.objects
        self._spacing = scene.object_spacing
        self._levels = self._height + scene.level_height * np.arange(scene.objects)
        self._tower_probability = tower_probability

    def _draw_one(self, rng: np.random.Generator) -> Start:
        places: list[Array] = []
        while len(places) < self._objects:
            place = self._draw_place(rng)
            if all(np.hypot(*(place - other)) >= self._spacing for other in places):
                places.append(place)
        goal = np.empty((self._objects, 3))
        goal[:] = (*places[0], self._height)
        if rng.uniform() < self._tower_probability:
            goal[:, 2] = self._levels
        else:
            goal[1:] = [self._draw_target(rng) for _ in range(1, self._objects)]
        return self._start(places, goal.ravel())


class TupleStarts(_TableStarts):
    """Lay the chain flat along x; the goal is one of its shapes somewhere on the table."""

    def __init__(self, scene: TupleScene, start: FetchStart, model: mujoco.MjModel, block: float) -> None:
        """Read the scene.

        Args:
            scene: the scene.
            start: how it settles.
            model: the scene with or without its robot.
            block: side of a block [m].
        """
        super().__init__(scene, start, model)
        self._shift = scene.start_shift
        self._flat = block * np.arange(scene.objects)
        self._shapes = [np.array([(x, 0.0, z) for x, z in shape.offsets]) for shape in scene.shapes]
        table = model.body("table0")
        half, centre = float(model.geom_size[int(table.geomadr[0]), 0]), float(table.pos[0])
        room = half - block / 2 if scene.stay_on_table else np.inf
        self._low, self._high = centre - room, centre + room

    def _draw_one(self, rng: np.random.Generator) -> Start:
        place = self._draw_place(rng, self._shift)
        while not self._is_on_table(place[0] + self._flat):
            place = self._draw_place(rng, self._shift)
        shape = self._shapes[rng.integers(len(self._shapes))]
        goal = self._draw_target(rng) + shape
        while not self._is_on_table(goal[:, 0]):
            goal = self._draw_target(rng) + shape
        return self._start([place], goal.ravel())

    def _is_on_table(self, x: Array) -> bool:
        return bool((x >= self._low).all() and (x <= self._high).all())
