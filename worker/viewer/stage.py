"""One track on the page: its scene and goals, the way its objects went, and the demonstration beside it."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
import viser
from numpy.typing import NDArray

from sldr_core.config import TaskSpec
from worker.viewer.against import VERBS, Against
from worker.viewer.commands import Command, unknown_command
from worker.viewer.scene import SOLID, Look, SceneView
from worker.viewer.skeleton import Kinematics
from worker.viewer.tracks import Track, goal_positions

PATH_RGB = (110, 110, 120)
PATH_WIDTH = 0.003
"""Width of the line along which an object went [m]."""


class Stage:
    """Draw a track at a step."""

    def __init__(
        self,
        server: viser.ViserServer,
        task: TaskSpec,
        model: mujoco.MjModel,
        against: Against | None = None,
        prefix: str = "/scene",
        look: Look = SOLID,
    ) -> None:
        self.against = against
        self._server, self._task = server, task
        self._view = SceneView(server, model, prefix, look)
        self._kinematics = Kinematics(model)
        self._path = PathLine(server, f"{prefix}/path", PATH_RGB, PATH_WIDTH)
        self._drawn: object = None
        self._poses = self._kinematics.poses(model.qpos0)

    @property
    def verbs(self) -> tuple[str, ...]:
        """The commands that it has."""
        return VERBS if self.against is not None else ()

    def draw(self, track: Track, step: int, share: float = 0.0) -> None:
        """Draw a step, or a moment a share of the way to the next; both have to be known or will be simulated."""
        now = track.moment(step)
        later = track.moment(step + 1) if share > 0.0 else now
        version = (id(track), track.version, step)
        with self._server.atomic():
            if (version, share) != self._drawn:
                self._drawn = version, share
                self._poses = self._kinematics.poses_between(now.qpos, later.qpos, share)
                self._view.show(self._poses)
                self._view.show_goals(goal_positions(self._task, now.goal), track.is_reached(step))
            if version != self._path.version:
                self._path.show(self._walked(track, step), version)
            if self.against is not None:
                self.against.draw(track, step, self._poses)

    def obey(self, command: Command, others: tuple[str, ...] = ()) -> None:
        """Do what a command of the demonstration says.

        Raises:
            BadCommand: there is none, or a value of it makes no sense.
        """
        if self.against is None or command.do not in VERBS:
            raise unknown_command(command, [*others, *self.verbs])
        self.against.obey(command)

    def state(self) -> dict[str, Any]:
        """Return what is drawn besides the track."""
        return self.against.state() if self.against is not None else {}

    def report(self, track: Track, step: int) -> dict[str, Any]:
        """Return the moment that is drawn, exactly."""
        moment = track.moment(step)
        shown: dict[str, Any] = {"qpos": moment.qpos, "qvel": moment.qvel, "goal": moment.goal}
        return shown | (self.against.report(track, step) if self.against is not None else {})

    def _walked(self, track: Track, step: int) -> NDArray[np.float64]:
        """Return the lines along which the objects went until a step, `[lines, 2, 3]`."""
        return walked_lines(self._task, np.stack([track.moment(past).achieved for past in range(step + 1)]))


def walked_lines(task: TaskSpec, achieved: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the lines along which the objects went that achieved goals `[steps, G]` tell of, `[lines, 2, 3]`."""
    places = achieved[:, :3] if task.family == "hand" else achieved
    positions = np.asarray(places, dtype=np.float64).reshape(len(achieved), -1, 3)
    return np.stack([positions[:-1], positions[1:]], axis=2).reshape(-1, 2, 3)


class PathLine:
    """Draw line segments that are sent anew only when they have changed.

    Attributes:
        version: of what is drawn.
    """

    def __init__(self, server: viser.ViserServer, path: str, colour: tuple[int, int, int], width: float) -> None:
        self._server, self._path = server, path
        self._colour, self._width = colour, width
        self.version: object = None
        self._node: viser.LineSegmentsHandle | None = None

    def show(self, segments: NDArray[np.float64], version: object) -> None:
        """Draw segments `[lines, 2, 3]`; what has the version of the last call is drawn already."""
        if version == self.version:
            return
        self.version = version
        if not len(segments):
            if self._node is not None:
                self._node.visible = False
        elif self._node is None:
            self._node = self._server.scene.add_line_segments(self._path, segments, self._colour, thickness=self._width)
        else:
            self._node.points = segments.astype(np.float32)
            self._node.visible = True
