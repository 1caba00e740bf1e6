"""How many episodes are laid out on one page: one stage, two beside each other, or a crowd."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Protocol

import mujoco
import numpy as np
import viser

from sldr_core.config import Phase, TaskSpec, TrainConfig
from worker.viewer.against import Against
from worker.viewer.camera import Camera, find_camera
from worker.viewer.crowd import Crowd, grid_offsets
from worker.viewer.page import look_through
from worker.viewer.scene import Look
from worker.viewer.skeleton import Kinematics
from worker.viewer.stage import Stage
from worker.viewer.tracks import Track, goal_positions

SPACING: dict[tuple[bool, Phase], tuple[float, float]] = {
    (False, "manipulation"): (2.0, 1.7),
    (False, "locomotion"): (1.3, 1.3),
    (True, "manipulation"): (0.7, 0.7),
    (True, "locomotion"): (0.7, 0.7),
}
"""From one copy of a scene to the next, by whether it is a hand's and by phase: x, y [m]."""

LABEL_HEIGHT = 0.35
"""How far above the middle of a scene its name stands, as a share of the camera's distance."""


class Display(Protocol):
    """Draw tracks on the page."""

    @property
    def tracks(self) -> Sequence[Track]:
        """What is drawn."""
        ...

    @property
    def against(self) -> Against | None:
        """The demonstration beside the only track, if there is one."""
        ...

    @property
    def verbs(self) -> tuple[str, ...]:
        """Its own commands."""
        ...

    def draw(self, step: int, share: float) -> None:
        """Draw a step of every track, or a moment a share of the way to the next."""
        ...

    def state(self) -> dict[str, Any]:
        """Return what is drawn besides the tracks."""
        ...

    def report(self, step: int) -> dict[str, Any]:
        """Return the moment that is drawn, exactly."""
        ...


class Row:
    """Draw one track, or a few beside each other, each with its own name."""

    def __init__(self, stages: Sequence[Stage], tracks: Sequence[Track]) -> None:
        self._stages, self.tracks = stages, tracks
        self.against = stages[0].against if len(stages) == 1 else None

    @property
    def verbs(self) -> tuple[str, ...]:
        """Those of the demonstration, if there is one."""
        return self._stages[0].verbs

    def draw(self, step: int, share: float) -> None:
        """Draw every stage."""
        for stage, track in zip(self._stages, self.tracks, strict=True):
            stage.draw(track, step, share)

    def state(self) -> dict[str, Any]:
        """Return what is drawn besides the tracks."""
        return self._stages[0].state()

    def report(self, step: int) -> dict[str, Any]:
        """Return the first track's moment, and those of all."""
        shown = self._stages[0].report(self.tracks[0], step)
        return shown | {"lanes": [{"qpos": track.moment(step).qpos} for track in self.tracks]}


class Lanes:
    """Draw many tracks of one scene as a crowd."""

    against = None
    verbs = ()

    def __init__(self, crowd: Crowd, task: TaskSpec, model: mujoco.MjModel, tracks: Sequence[Track]) -> None:
        self._crowd, self._task, self.tracks = crowd, task, tracks
        self._kinematics = Kinematics(model)

    def draw(self, step: int, share: float) -> None:
        """Draw every copy."""
        now = [track.moment(step) for track in self.tracks]
        later = [track.moment(step + 1) for track in self.tracks] if share > 0.0 else now
        self._crowd.show(
            [
                self._kinematics.poses_between(before.qpos, after.qpos, share)
                for before, after in zip(now, later, strict=True)
            ]
        )
        for copy, (track, moment) in enumerate(zip(self.tracks, now, strict=True)):
            self._crowd.show_goals(copy, goal_positions(self._task, moment.goal), track.is_reached(step))

    def state(self) -> dict[str, Any]:
        """Return nothing: there are only tracks."""
        return {}

    def report(self, step: int) -> dict[str, Any]:
        """Return the first track's moment, and those of all."""
        first = self.tracks[0].moment(step)
        lanes = [{"qpos": track.moment(step).qpos} for track in self.tracks]
        return {"qpos": first.qpos, "qvel": first.qvel, "goal": first.goal, "lanes": lanes}


def show_lanes(
    server: viser.ViserServer,
    config: TrainConfig,
    model: mujoco.MjModel,
    tracks: Sequence[Track],
    against: Against | None = None,
    names: Sequence[str] = (),
) -> Display:
    """Lay tracks out and point the camera at them; names are written above where there is more than one."""
    task, camera = config.task_spec, find_camera(config.task_spec, config.phase)
    spacing = SPACING[task.family == "hand", config.phase]
    if len(tracks) == 1:
        look_through(server, camera)
        return Row([Stage(server, task, model, against)], tracks)
    offsets = grid_offsets(len(tracks), spacing)
    look_through(server, _step_back(camera, len(tracks)))
    if len(tracks) > len(names):
        return Lanes(Crowd(server, model, offsets), task, model, tracks)
    stages = []
    for number, (name, offset) in enumerate(zip(names, offsets, strict=True)):
        place = (float(offset[0]), float(offset[1]), 0.0)
        stages.append(Stage(server, task, model, None, f"/side{number}", Look(offset=place)))
        above = np.asarray(camera.look_at) + offset + (0.0, 0.0, LABEL_HEIGHT * camera.distance)
        server.scene.add_label(f"/side{number}-name", name, position=above)
    return Row(stages, tracks)


def _step_back(camera: Camera, count: int) -> Camera:
    """Return a camera that sees `count` scenes."""
    return replace(camera, distance=camera.distance * (1.5 if count == 2 else 1.0 + 0.55 * np.sqrt(count)))
