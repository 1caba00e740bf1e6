"""Everything of the inspector that is drawn in the scene, from what is looked at and what a person wants to see."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import viser
from numpy.typing import NDArray

from sldr_core.demonstrations import Landscape, evaluate_turns
from worker.viewer.arrows import HAND_ARROWS, TABLE_ARROWS, WANTED_RGB, ActionArrows
from worker.viewer.inspector.acting_scene import ActingScene, Moment
from worker.viewer.inspector.grips import Grips
from worker.viewer.inspector.inspection import Inspection
from worker.viewer.inspector.paths import Paths
from worker.viewer.inspector.surfaces import SHELL_ANGLE, Surfaces, sheet_of


@dataclass
class Looks:
    """What a person wants to see."""

    path: bool = True
    """The path of the demonstration that is played."""
    fan: bool = True
    """The paths of the fan."""
    arrows: bool = True
    """What the object wants."""
    surface: bool = False
    """The slice of Q."""
    grips: bool = False
    """What start and goal are dragged by."""


class Drawing:
    """Draw a moment, and what stays from one to the next only when it changes."""

    def __init__(self, server: viser.ViserServer, inspection: Inspection) -> None:
        self._server, self._inspection = server, inspection
        task = inspection.inspected.task
        self._arrow_size = HAND_ARROWS if task.family == "hand" else TABLE_ARROWS
        self._paths, self._arrows = Paths(server, task), ActionArrows(server, "/wanted", WANTED_RGB, self._arrow_size)
        self._surfaces, self._grips = Surfaces(server), Grips(server, task)
        self._scene = self._open_scene()
        self._path_version = self._fan_version = -1

    def change_scene(self) -> None:
        """Draw the scene of the starts that are used now."""
        self._arrows.hide()
        self._surfaces.clear()
        self._grips.clear()
        self._scene.remove()
        self._scene = self._open_scene()

    def take_drags(self) -> bool:
        """Put object and goal where they were dragged to, and tell whether they were."""
        return self._grips.take({"start": self._inspection.put_object, "goal": self._inspection.put_goal})

    def show_moment(self, step: int, share: float, looks: Looks) -> None:
        """Draw the bodies a share of the way from a step to the next, and the step's arrows."""
        shown = self._inspection.demonstration
        later = min(step + 1, shown.steps)
        now = Moment(shown.qpos[:, step], shown.start.goal, shown.reached[:, step])
        between = self._scene.poses_between(now.qpos, shown.qpos[:, later], share)
        with self._server.atomic():
            self._scene.show(between, now)
            if looks.arrows:
                bodies = self._scene.pulled_bodies()
                action = shown.action[:, min(step, shown.steps - 1)].ravel()
                self._arrows.show(action, between.pos[bodies], between.quat[bodies])
            else:
                self._arrows.hide()

    def show_paths(self, looks: Looks) -> None:
        """Draw the paths that have changed."""
        inspection = self._inspection
        path_version = inspection.version if looks.path else 0
        if path_version != self._path_version:
            self._path_version = path_version
            self._paths.show_one(inspection.demonstration if looks.path else None)
        fan_version = inspection.fan_version if looks.fan else 0
        if fan_version != self._fan_version:
            self._fan_version = fan_version
            self._paths.show_fan(inspection.fan if looks.fan else None)

    def show_grips(self, looks: Looks) -> None:
        """Put the grips where object and goal are, or take them away."""
        inspection, start = self._inspection, self._inspection.demonstration.start
        if looks.grips and inspection.source.group == 1:
            self._grips.show(inspection.placing.object_pose(start), inspection.placing.goal_pose(start))
        else:
            self._grips.clear()

    def show_surface(self, landscape: Landscape | None, step: int, part: int) -> None:
        """Draw a slice of Q at a step of one of the objects, or none."""
        inspection = self._inspection
        if landscape is None:
            self._surfaces.clear()
            return
        state, goal = inspection.moment(step, part)
        place = self._places(step)[part if inspection.source.group > 1 else landscape.slice.body]
        is_turn = landscape.slice.kind == "turn" or (landscape.slice.kind == "action" and landscape.slice.axes[0] > 2)
        if is_turn:
            nets = inspection.inspected.model.nets
            values = evaluate_turns(nets, state, goal, self._surfaces.directions, SHELL_ANGLE)
            self._surfaces.show_shell(values, place)
        else:
            at = goal[:3] if landscape.slice.kind == "goal" else place
            self._surfaces.show_sheet(landscape, sheet_of(landscape, at, self._arrow_size.reach))

    def _open_scene(self) -> ActingScene:
        return ActingScene(self._server, self._inspection.source.task, self._inspection.envs.model)

    def _places(self, step: int) -> NDArray[np.float64]:
        """Return where the bodies that act are at a step [m], `[M, 3]`."""
        poses = self._scene.poses(self._inspection.demonstration.qpos[:, step])
        return poses.pos[self._scene.pulled_bodies()]
