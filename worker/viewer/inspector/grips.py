"""Two grips in the scene, by which a person moves the object's start and its goal."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import viser
from numpy.typing import NDArray

from sldr_core.config import PoseGoal, TaskSpec
from sldr_core.envs.hand import TARGET_ASIDE
from worker.viewer.gizmos import HAND_SIZE, TABLE_SIZE, is_shown_aside

Array = NDArray[np.float64]
Pose = tuple[Array, Array]
"""Position [m] and quaternion, w first."""


@dataclass
class _Grip:
    """One grip and the pose it was dragged to last."""

    node: viser.TransformControlsHandle
    lock: threading.Lock
    dragged: Pose | None = None

    def take(self) -> Pose | None:
        """Return where it was dragged since the last call."""
        with self.lock:
            dragged, self.dragged = self.dragged, None
        return dragged

    def remember(self) -> None:
        """Keep where it is: called by the page's server, in a thread of its own."""
        with self.lock:
            self.dragged = np.asarray(self.node.position, dtype=float), np.asarray(self.node.wxyz, dtype=float)


class Grips:
    """Show both grips and pass on where they were dragged."""

    def __init__(self, server: viser.ViserServer, task: TaskSpec) -> None:
        self._server, self._task = server, task
        self._grips: dict[str, _Grip] = {}

    def show(self, start: Pose, goal: Pose) -> None:
        """Put them where object and goal are."""
        aside = np.asarray(TARGET_ASIDE) if is_shown_aside(self._task) else np.zeros(3)
        for name, pose in (("start", start), ("goal", (goal[0] + aside, goal[1]))):
            grip = self._grips.get(name) or self._add(name, pose)
            grip.node.position, grip.node.wxyz = pose

    def clear(self) -> None:
        """Take them away."""
        for grip in self._grips.values():
            grip.node.remove()
        self._grips = {}

    def take(self, put: dict[str, Callable[[Array, Array], None]]) -> bool:
        """Call what belongs to each grip that was dragged, and tell whether one was."""
        dragged = {name: pose for name, grip in self._grips.items() if (pose := grip.take()) is not None}
        for name, (position, quaternion) in dragged.items():
            put[name](position, quaternion)
        return bool(dragged)

    def _add(self, name: str, pose: Pose) -> _Grip:
        goal = self._task.goal
        turns = isinstance(goal, PoseGoal) and (name == "start" or goal.angle is not None)
        moves = name == "start" or not isinstance(goal, PoseGoal) or goal.distance is not None
        node = self._server.scene.add_transform_controls(
            f"/grips/{name}",
            scale=HAND_SIZE if self._task.family == "hand" else TABLE_SIZE,
            disable_axes=not moves,
            disable_sliders=not moves,
            disable_rotations=not turns,
            depth_test=False,
            position=pose[0],
            wxyz=pose[1],
        )
        grip = self._grips[name] = _Grip(node, threading.Lock())
        node.on_update(lambda _: grip.remember())
        return grip
