"""Paths of demonstrations as thin lines: a fan of many, coloured by how they ended, and the one that is played.

`N` demonstrations, `T` steps, `G` goal.
"""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from sldr_core.config import TaskSpec
from sldr_core.demonstrations import Demonstration, Fan
from sldr_core.envs.rotations import matrix_from_quaternion
from worker.viewer.inspector.colours import FAILURE_RGB, SHOWN_RGB, SUCCESS_RGB

MOST_PATHS = 480
"""Paths that are drawn at most; failures come first."""

EVERY = 2
"""Only every second step of a fan's path is drawn."""

MARK_RADIUS = 0.045
"""The path of an object that only turns is that of a point so far from its middle [m]."""

SUCCESS_WIDTH, FAILURE_WIDTH, SHOWN_WIDTH = 0.0009, 0.0018, 0.003
"""Thickness of lines [m]."""

Array = NDArray[np.float64]


def path_points(task: TaskSpec, achieved: Array, goal: Array) -> list[Array]:
    """Return the points, one or two, whose paths are drawn, each `[N, T+1, 3]`.

    Of a block it is its middle, of a chain the middles of its ends. Of an object that has only to turn it is the
    point that is on top once it is turned as it should be: all paths that succeed end on top.

    Args:
        task: the task in which the object learnt.
        achieved: `[N, T+1, G]`.
        goal: `[N, G]`.
    """
    if task.family != "hand":
        ends = sorted({0, task.goal_size // 3 - 1})
        return [achieved[..., 3 * end : 3 * end + 3] for end in ends]
    if task.goal.distance is not None:
        return [achieved[..., :3]]
    mark = matrix_from_quaternion(goal[:, 3:])[:, 2]  # the third row: the goal's turn, undone, of straight up
    return [
        achieved[..., :3] + MARK_RADIUS * np.einsum("ntij,nj->nti", matrix_from_quaternion(achieved[..., 3:]), mark)
    ]


def chosen_paths(reached: NDArray[np.bool_], most: int = MOST_PATHS) -> NDArray[np.int64]:
    """Return which of `N` demonstrations are drawn: all if there is room, else failures first, by number."""
    return np.sort(np.argsort(reached[:, -1], kind="stable")[:most])


def segments(path: Array) -> Array:
    """Return the pieces of paths `[N, T+1, 3]` from each point to the next, `[N T, 2, 3]`."""
    return np.stack([path[:, :-1], path[:, 1:]], axis=2).reshape(-1, 2, 3)


class Paths:
    """Draw them below two nodes of the scene, each drawn anew when its paths change."""

    def __init__(self, server: viser.ViserServer, task: TaskSpec) -> None:
        self._server, self._task = server, task
        self._fan: viser.FrameHandle | None = None
        self._shown: viser.FrameHandle | None = None

    def show_fan(self, fan: Fan | None) -> None:
        """Draw a fan, or none."""
        with self._server.atomic():
            self._fan = self._clear(self._fan, "/fan")
            if fan is None:
                return
            chosen = chosen_paths(fan.reached)
            reached = fan.reached[chosen, -1]
            for end, point in enumerate(path_points(self._task, fan.achieved[chosen], fan.start.goal[chosen])):
                thin = np.concatenate([point[:, :-1:EVERY], point[:, -1:]], axis=1)
                self._add(f"/fan/successes{end}", thin[reached], SUCCESS_RGB, SUCCESS_WIDTH)
                self._add(f"/fan/failures{end}", thin[~reached], FAILURE_RGB, FAILURE_WIDTH)

    def show_one(self, shown: Demonstration | None) -> None:
        """Draw the path of the demonstration that is played, or none."""
        with self._server.atomic():
            self._shown = self._clear(self._shown, "/shown")
            if shown is None:
                return
            for end, point in enumerate(path_points(self._task, shown.achieved, shown.start.goal)):
                self._add(f"/shown/path{end}", point, SHOWN_RGB, SHOWN_WIDTH)

    def _clear(self, group: viser.FrameHandle | None, name: str) -> viser.FrameHandle:
        """Take a group of paths away and return a new, empty one."""
        if group is not None:
            group.remove()
        return self._server.scene.add_frame(name, show_axes=False)

    def _add(self, name: str, path: Array, colour: tuple[int, int, int], thickness: float) -> None:
        if path.size:
            self._server.scene.add_line_segments(name, segments(path), colour, thickness=thickness)
