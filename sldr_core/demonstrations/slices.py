"""The slices of Q_nu that make sense for a task, and how far they reach."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sldr_core.config import FetchScene, PoseGoal, TaskSpec, TupleScene
from sldr_core.demonstrations.coverage import Space
from sldr_core.demonstrations.landscape import Slice, SliceKind
from sldr_core.demonstrations.spaces import CM_PER_M
from sldr_core.errors import UnknownName

AXES: tuple[str, ...] = ("x", "y", "z", "turn about x", "turn about y", "turn about z")
"""The names of a slice's axes, by number."""

MARGIN = 0.05
"""How far slices reach beyond where starts and goals are drawn [m]."""

HAND_WINDOW = 0.06
"""How far slices reach around where objects lie in the hand [m]."""

UP = 0.45
"""How far slices reach above the table [m]."""

TITLES: dict[SliceKind, str] = {
    "position": "value of being elsewhere",
    "goal": "value of another goal",
    "turn": "value of being turned otherwise",
    "action": "value of doing something else",
}
"""What each kind tells."""

_PLANES = ((0, 1), (0, 2), (1, 2))
_TURNS = ((3, 4), (3, 5), (4, 5))


@dataclass(frozen=True)
class SliceChoices:
    """The slices that can be drawn of a task, by kind, each with its planes; the first kind tells most."""

    planes: dict[SliceKind, tuple[tuple[int, int], ...]]
    low: NDArray[np.float64]
    """Least position [m], `[3]`."""
    high: NDArray[np.float64]
    """Greatest position [m], `[3]`."""

    def make(self, kind: str, plane: int, body: int) -> Slice:
        """Return a slice by its kind and the number of its plane.

        Raises:
            UnknownName: the task has no such slice.
        """
        chosen = self.find_kind(kind)
        if not 0 <= plane < len(self.planes[chosen]):
            raise UnknownName(f"plane of '{kind}'", str(plane), map(str, range(len(self.planes[chosen]))))
        axes = self.planes[chosen][plane]
        across, up = (self._reach(chosen, axis) for axis in axes)
        return Slice(chosen, axes, across, up, body)

    def find_kind(self, name: str) -> SliceKind:
        """Return a kind of slice by its name.

        Raises:
            UnknownName: the task has no such slice.
        """
        for kind in self.planes:
            if kind == name:
                return kind
        raise UnknownName("slice of this task", name, self.planes)

    def _reach(self, kind: SliceKind, axis: int) -> tuple[float, float]:
        if kind == "action":
            return -1.0, 1.0
        if kind == "turn":
            return -np.pi, np.pi
        return float(self.low[axis]), float(self.high[axis])


def slices_of(task: TaskSpec, spaces: tuple[Space, ...], rest: NDArray[np.float64]) -> SliceChoices:
    """Return the slices of a task.

    Args:
        task: the task in which the object learnt.
        spaces: where its starts and goals are drawn.
        rest: where an object comes to rest [m], `[3]`.
    """
    if isinstance(task.goal, PoseGoal):
        return SliceChoices(_pose_planes(task.goal), rest - HAND_WINDOW, rest + HAND_WINDOW)
    in_the_air = isinstance(task.scene, TupleScene) or (
        isinstance(task.scene, FetchScene) and task.scene.target_in_the_air
    )
    planes = _PLANES if in_the_air else _PLANES[:1]
    low = [min(space.x.edges[0] for space in spaces), min(space.y.edges[0] for space in spaces)]
    high = [max(space.x.edges[-1] for space in spaces), max(space.y.edges[-1] for space in spaces)]
    return SliceChoices(
        {"position": planes, "action": _PLANES, "goal": planes},
        np.array([*(np.array(low) / CM_PER_M - MARGIN), rest[2]]),
        np.array([*(np.array(high) / CM_PER_M + MARGIN), rest[2] + UP]),
    )


def _pose_planes(goal: PoseGoal) -> dict[SliceKind, tuple[tuple[int, int], ...]]:
    planes: dict[SliceKind, tuple[tuple[int, int], ...]] = {}
    if goal.angle is not None:
        planes["turn"] = _PLANES
    if goal.distance is not None:
        planes["position"] = planes["goal"] = _PLANES
    planes["action"] = (*_TURNS, *_PLANES) if goal.angle is not None else _PLANES
    return planes
