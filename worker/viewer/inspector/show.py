"""The view of a locomotion model's demonstrations: the clock, and the commands of the page."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import viser

from sldr_core.config import TupleScene
from sldr_core.demonstrations import BLOCK, MOST, Landscape, load_inspected
from worker.viewer.camera import find_camera
from worker.viewer.commands import BadCommand, Command, unknown_command
from worker.viewer.inspector.answers import (
    tell_about,
    tell_failures,
    tell_fan,
    tell_map,
    tell_slice,
    tell_timeline,
)
from worker.viewer.inspector.drawing import Drawing, Looks
from worker.viewer.inspector.inspection import Inspection
from worker.viewer.page import look_through
from worker.viewer.reports import Job
from worker.viewer.transport import Transport

MOST_SEEDS = 2**31 - 1
MOST_NUMBERS = 10**6

SLICE_S = 0.15
"""Time between two evaluations of a slice while the clock runs [s]."""

FAN_DRAWN_S = 0.5
"""Time between two drawings of a fan while it grows [s]."""

LOOKS = ("path", "fan", "arrows", "surface", "grips")
"""What can be shown and hidden."""

Answer = dict[str, Any] | None


def open_inspector(server: viser.ViserServer, job: Job) -> InspectorShow:
    """Open the view of a job's locomotion model.

    Raises:
        BadFile: the model cannot be used.
    """
    return InspectorShow(server, Inspection(load_inspected(job.file("locomotion"))))


class InspectorShow:
    """Play demonstrations, collect fans of them, and show what Q makes of the moment."""

    def __init__(self, server: viser.ViserServer, inspection: Inspection) -> None:
        self._inspection = inspection
        self._looks = Looks()
        self._drawing = Drawing(server, inspection)
        self.transport = Transport(inspection.demonstration.steps)
        self._kind, self._plane, self._body, self._part = next(iter(inspection.slices.planes)), 0, 0, 0
        self._landscape: Landscape | None = None
        self._slice_version = 0
        self._slice_of: tuple[int, ...] = ()
        self._slice_age_s = self._fan_age_s = 0.0
        self._verbs: dict[str, Callable[[Command], Answer]] = {
            "about": lambda command: tell_about(inspection),
            "open": self._open,
            "starts": self._use_starts,
            "place": self._place,
            "shape": self._put_shape,
            "fan": self._start_fan,
            "stop-fan": lambda command: inspection.stop_fan(),
            "look": self._look,
            "choose-slice": self._choose_slice,
            "slice": self._tell_slice,
            "map": self._tell_map,
            "failures": lambda command: tell_failures(inspection),
            "timeline": lambda command: tell_timeline(inspection),
        }
        look_through(server, find_camera(inspection.inspected.task, "locomotion"))

    @property
    def message(self) -> str:
        """What is shown, in one sentence."""
        inspected = self._inspection.inspected
        return (
            f"What the object of {inspected.task.name} makes itself do: demonstrations of the locomotion model, "
            f"which reached {inspected.model.measured.success_rate:.0%} of its test goals."
        )

    def advance(self, wall_s: float) -> None:
        """Let time pass, collect what is due, and draw."""
        if self._drawing.take_drags():
            self.transport.seek(0)
        self.transport.advance(wall_s)
        if self.transport.has_ended:
            self.transport.seek(0)
        self._inspection.advance_fan()
        self._drawing.show_moment(self.transport.step, self.transport.share, self._looks)
        self._fan_age_s += wall_s
        if self._fan_age_s >= FAN_DRAWN_S or self._inspection.collecting is None:
            self._fan_age_s = 0.0
            self._drawing.show_paths(self._looks)
        self._drawing.show_grips(self._looks)
        self._renew_slice(wall_s)

    def obey(self, command: Command) -> Answer:
        """Do what the page asks, or refuse."""
        if command.do not in self._verbs:
            raise unknown_command(command, list(self._verbs))
        return self._verbs[command.do](command)

    def state(self) -> dict[str, Any]:
        """Return what is looked at, and which versions of everything there are."""
        inspection = self._inspection
        shown = inspection.demonstration
        return {
            "starts": inspection.source.task.name,
            "seed": inspection.shown_seed,
            "number": inspection.number,
            "origin": inspection.origin,
            "exact": inspection.is_exact,
            "timeline": inspection.version,
            "known": shown.steps,
            "reached": shown.reached[:, -1].all(),
            "looks": vars(self._looks),
            "slice": {
                "version": self._slice_version,
                "kind": self._kind,
                "plane": self._plane,
                "body": self._body,
                "part": self._part,
            },
            "fan": tell_fan(inspection),
        }

    def report(self) -> dict[str, Any]:
        """Return the moment that is drawn: of objects that act side by side, joint positions one after the other."""
        step = self.transport.step
        shown = self._inspection.demonstration
        return {"qpos": shown.qpos[:, step].ravel(), "goal": shown.start.goal.ravel()}

    def _renew_slice(self, wall_s: float) -> None:
        """Evaluate the slice of the moment again if it is shown and the moment is another."""
        if not self._looks.surface:
            self._landscape, self._slice_of = None, ()
            self._drawing.show_surface(None, 0, 0)
            return
        self._slice_age_s += wall_s
        inspection, step = self._inspection, self.transport.step
        wanted = (inspection.version, step, self._part, self._body, self._plane, hash(self._kind))
        # While the clock runs a slice may be a little late; at rest it is exact.
        due = self._slice_age_s >= SLICE_S or not self.transport.is_playing
        if wanted != self._slice_of and due:
            self._slice_of, self._slice_age_s = wanted, 0.0
            self._landscape = inspection.evaluate(
                inspection.slices.make(self._kind, self._plane, self._body), step, self._part
            )
            self._slice_version += 1
            self._drawing.show_surface(self._landscape, step, self._part)

    def _open(self, command: Command) -> Answer:
        self._inspection.seed = command.integer("seed", 0, MOST_SEEDS)
        self._show_from_start(lambda: self._inspection.show_number(command.integer("number", 0, MOST_NUMBERS)))

    def _use_starts(self, command: Command) -> Answer:
        task = command.choice("task", self._inspection.inspected.start_tasks)
        self._part = 0
        self._show_from_start(lambda: self._inspection.use_starts(task))
        self._drawing.change_scene()

    def _place(self, command: Command) -> Answer:
        put = {"start": self._inspection.put_object, "goal": self._inspection.put_goal}
        what = command.choice("what", tuple(put))
        position, quaternion = command.vector("position", 3), command.quaternion("quaternion")
        self._show_from_start(lambda: put[what](position, quaternion))

    def _put_shape(self, command: Command) -> Answer:
        scene = self._inspection.inspected.task.scene
        if not isinstance(scene, TupleScene):
            raise BadCommand("Only the goals of chains have shapes.")
        shape = command.integer("shape", 0, len(scene.shapes) - 1)
        placing = self._inspection.placing
        self._show_from_start(lambda: self._inspection.place(lambda start: placing.put_shape(start, shape)))

    def _start_fan(self, command: Command) -> Answer:
        blocks = command.integer("count", BLOCK, MOST) // BLOCK
        self._inspection.start_fan(blocks * BLOCK, command.integer("seed", 0, MOST_SEEDS))

    def _look(self, command: Command) -> Answer:
        setattr(self._looks, command.choice("at", LOOKS), command.flag("on"))

    def _choose_slice(self, command: Command) -> Answer:
        slices, task = self._inspection.slices, self._inspection.inspected.task
        kind = slices.find_kind(command.choice("kind", tuple(slices.planes)))
        self._plane = command.integer("plane", 0, len(slices.planes[kind]) - 1)
        self._body = command.integer("body", 0, task.object_action_size // 7 - 1)
        self._part = command.integer("part", 0, self._inspection.source.group - 1)
        self._kind, self._looks.surface = kind, True
        self._drawing.show_surface(None, 0, 0)

    def _tell_slice(self, command: Command) -> Answer:
        if self._landscape is None:
            raise BadCommand('No slice is shown; choose one with "choose-slice".')
        return tell_slice(self._landscape, self._slice_version)

    def _tell_map(self, command: Command) -> Answer:
        spaces = {space.name: space for space in self._inspection.spaces}
        return tell_map(self._inspection, spaces[command.choice("space", tuple(spaces))])

    def _show_from_start(self, show: Callable[[], None]) -> None:
        show()
        self.transport.seek(0)
