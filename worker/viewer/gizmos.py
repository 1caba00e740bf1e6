"""Goals that can be dragged in the scene, with Viser's transform gizmos."""

from __future__ import annotations

import threading

import numpy as np
import viser
from numpy.typing import NDArray

from sldr_core.config import HandScene, PoseGoal, TaskSpec
from sldr_core.envs.hand import TARGET_ASIDE

TABLE_SIZE = 0.12
HAND_SIZE = 0.07
"""Length of a gizmo's axes [m]."""


class GoalGizmos:
    """One gizmo for each goal that a person can move by itself: one for each block of a stack, one for a whole chain.

    A page's hand moves them in Viser's thread; the session's loop takes what was wished for.
    """

    def __init__(self, server: viser.ViserServer, task: TaskSpec) -> None:
        self._task = task
        self._lock = threading.Lock()
        self._wished: NDArray[np.float64] | None = None
        self._goal = np.zeros(task.goal_size)
        self._aside = np.asarray(TARGET_ASIDE) if is_shown_aside(task) else np.zeros(3)
        count = 1 if task.family in ("hand", "tuple") else task.goal_size // 3
        self._nodes = [self._add(server, index) for index in range(count)]

    @property
    def visible(self) -> bool:
        """Whether they are drawn."""
        return self._nodes[0].visible

    @visible.setter
    def visible(self, value: bool) -> None:
        for node in self._nodes:
            node.visible = value

    def take(self) -> NDArray[np.float64] | None:
        """Return the goal that was dragged to since the last call, `[G]`, or None."""
        with self._lock:
            wished, self._wished = self._wished, None
        return wished

    def show(self, goal: NDArray[np.float64]) -> None:
        """Put the gizmos to a goal `[G]` that did not come from them."""
        with self._lock:
            if np.array_equal(goal, self._goal):
                return
            self._goal = goal.copy()
        for index, node in enumerate(self._nodes):
            node.position = goal[3 * index : 3 * index + 3] + self._aside
            if self._task.family == "hand":
                node.wxyz = goal[3:7]

    def _add(self, server: viser.ViserServer, index: int) -> viser.TransformControlsHandle:
        is_hand, criterion = self._task.family == "hand", self._task.goal
        node = server.scene.add_transform_controls(
            f"/goal-gizmo/{index}",
            scale=HAND_SIZE if is_hand else TABLE_SIZE,
            disable_rotations=not isinstance(criterion, PoseGoal) or criterion.angle is None,
            disable_axes=criterion.distance is None,
            disable_sliders=criterion.distance is None,
            depth_test=False,
        )
        node.on_update(lambda _: self._dragged(index))
        return node

    def _dragged(self, index: int) -> None:
        node = self._nodes[index]
        with self._lock:
            goal = self._goal.copy()
            shift = np.asarray(node.position) - self._aside - goal[3 * index : 3 * index + 3]
            if self._task.family == "tuple":
                goal += np.tile(shift, len(goal) // 3)
            else:
                goal[3 * index : 3 * index + 3] += shift
            if self._task.family == "hand":
                goal[3:7] = node.wxyz
            self._goal = self._wished = goal


def is_shown_aside(task: TaskSpec) -> bool:
    """Tell whether the target stands beside its goal, so as not to hide the object."""
    return isinstance(task.scene, HandScene) and task.scene.target_position == "ignore"
