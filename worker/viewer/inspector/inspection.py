"""What the inspector looks at: one demonstration, the fan it belongs to, and a slice of Q. It draws nothing.

`P` objects that act side by side: those of a stack, else one.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sldr_core.demonstrations import (
    BLOCK,
    Demonstration,
    Drawn,
    Fan,
    FanCollection,
    Inspected,
    Landscape,
    Slice,
    demonstrate,
    evaluate_slice,
    slices_of,
    spaces_of,
)
from sldr_core.envs import Start
from worker.viewer.commands import BadCommand

Origin = Literal["drawn", "replayed", "placed"]
"""Where the demonstration comes from: a new one from its number, one of the fan again, or a start or goal by hand."""

FAN_BUDGET_S = 0.02
"""A fan is collected for so long between two frames [s]; one control step of a block may take longer."""


class Inspection:
    """Hold what is looked at. Whatever changes has a version, so that others know when to ask again.

    Attributes:
        demonstration: what the objects do, every moment of it.
        seed: the seed of the fan, and of the demonstrations that are shown next.
        number, shown_seed: which one is shown; of a stack, `number` counts stacks.
        origin: how it came about.
        is_exact: of a replayed one, whether it came out the same to the last bit.
        version: counts the demonstrations.
        fan: the demonstrations collected so far, None before the first block.
        fan_version: counts what was collected.
    """

    def __init__(self, inspected: Inspected, seed: int = 0) -> None:
        self.inspected = inspected
        self.seed = self.shown_seed = seed
        self.number, self.version = 0, 0
        self.origin: Origin = "drawn"
        self.is_exact: bool | None = None
        self.fan: Fan | None = None
        self.fan_version = 0
        self._collection: FanCollection | None = None
        self._crowd = inspected.make_envs(BLOCK)
        self.use_starts(inspected.task.name)

    @property
    def collecting(self) -> FanCollection | None:
        """The fan that is being collected now."""
        return self._collection

    def use_starts(self, task: str) -> None:
        """Draw starts and goals as another task does, and forget the fan.

        Raises:
            UnknownName: that task has other objects.
        """
        self.source = self.inspected.starts(task, self._crowd)
        self.envs = self.inspected.make_envs(self.source.group)
        self.placing = self.inspected.placing(self.envs)
        self.spaces = spaces_of(self.source.task, self.envs.model)
        self.slices = slices_of(self.inspected.task, self.spaces, self.placing.rest)
        self.fan, self._collection = None, None
        self.fan_version += 1
        self.show_number(0)

    def show_number(self, number: int) -> None:
        """Show a demonstration by its number: again, if it is of the fan."""
        first = number * self.source.group
        indices = range(first, first + self.source.group)
        self.number, self.shown_seed = number, self.seed
        drawn = self.source.draw(self.seed, indices)
        fan = self.fan
        if fan is not None and fan.seed == self.seed and indices[-1] < fan.count:
            kept = slice(indices[0], indices[-1] + 1)
            self._show(demonstrate(self.envs, drawn, self.inspected.act, given=fan.action[kept]), "replayed")
            self.is_exact = np.array_equal(self.demonstration.achieved, fan.achieved[kept])
        else:
            self._show(demonstrate(self.envs, drawn, self.inspected.act), "drawn")

    def place(self, change: Callable[[Start], Start]) -> None:
        """Show the demonstration from a start or toward a goal that was put by hand.

        Raises:
            BadCommand: the objects of a stack lie where the stack's task has them.
        """
        if self.source.group > 1:
            raise BadCommand("The objects of a stack cannot be put by hand; choose the starts of one object first.")
        start = change(self.demonstration.start)
        rngs = self.source.draw(self.shown_seed, [self.number]).rngs
        self._show(demonstrate(self.envs, Drawn(start, rngs), self.inspected.act), "placed")

    def put_object(self, position: ArrayLike, quaternion: ArrayLike) -> None:
        """Put the object elsewhere."""
        self.place(lambda start: self.placing.put_object(start, position, quaternion))

    def put_goal(self, position: ArrayLike, quaternion: ArrayLike) -> None:
        """Put the goal elsewhere."""
        self.place(lambda start: self.placing.put_goal(start, position, quaternion))

    def start_fan(self, count: int, seed: int) -> None:
        """Begin to collect a fan; `advance_fan` goes on with it."""
        self.seed, self.fan = seed, None
        self._collection = FanCollection(self._crowd, self.inspected.act, self.source, seed, count)
        self.fan_version += 1

    def stop_fan(self) -> None:
        """Leave the fan as it is."""
        self._collection = None
        self.fan_version += 1

    def advance_fan(self, budget_s: float = FAN_BUDGET_S) -> None:
        """Collect for a while."""
        until = time.monotonic() + budget_s
        while self._collection is not None and time.monotonic() < until:
            done = self._collection.done
            more = self._collection.advance()
            if self._collection.done > done:
                self.fan = self._collection.fan()
                self.fan_version += 1
            if not more:
                self._collection = None
                self.fan_version += 1

    def evaluate(self, plane: Slice, step: int, part: int) -> Landscape:
        """Return Q over a slice through a moment of one of the objects."""
        state, goal = self.moment(step, part)
        return evaluate_slice(self.inspected.model.nets, self.inspected.task, plane, state, goal)

    def moment(self, step: int, part: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return what one of the objects sees of itself at a step `[Z]`, and its goal `[G]`."""
        state = self.demonstration.state[part, step].astype(np.float64)
        return state, self.demonstration.start.goal[part]

    def _show(self, demonstration: Demonstration, origin: Origin) -> None:
        self.demonstration, self.origin, self.is_exact = demonstration, origin, None
        self.version += 1
