"""Robot against demonstration: the ghost of what the object would do by itself, and both wishes as arrows.

The ghost is drawn one step ahead of the moment shown, or as a whole demonstration that began at some step.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
import viser
from numpy.typing import NDArray

from worker.viewer.arrows import INDUCED_RGB, WANTED_RGB, ActionArrows, ArrowSize
from worker.viewer.commands import Command
from worker.viewer.demonstration import PartDemonstration
from worker.viewer.scene import Look, SceneView
from worker.viewer.simulated import Array
from worker.viewer.skeleton import Kinematics, Poses
from worker.viewer.tracks import Track

GHOST_LOOK = Look(opacity=0.45, tint=(0.35, 0.72, 1.0), objects_only=True)
"""Blue, like the arrows of what the object wants."""

MODES = ("off", "step", "whole")
"""No ghost; one step ahead of the moment shown; a whole demonstration on the same clock."""

VERBS = ("ghost", "arrows")

PATH_WIDTH = 0.004
"""Width of the ghost's path [m]."""


class Against:
    """Draw the demonstration of every part beside a track.

    Attributes:
        mode: how the ghost goes.
        origin: the step at which the whole demonstration begins.
    """

    def __init__(
        self, server: viser.ViserServer, robot_scene: mujoco.MjModel, parts: list[PartDemonstration], size: ArrowSize
    ) -> None:
        self.mode, self.origin = "step", 0
        self._shows_turns = self._shows_arrows = True
        self._robot_scene = robot_scene
        self._ghosts = [_Ghost(server, robot_scene, part, size) for part in parts]

    def obey(self, command: Command) -> None:
        """Do what one of `VERBS` says.

        Raises:
            BadCommand: a value of it makes no sense.
        """
        if command.do == "arrows":
            self._shows_arrows = command.flag("on")
            self._shows_turns = self._shows_arrows and command.flag("turns")
            return
        self.mode = command.choice("mode", MODES)
        if self.mode == "whole":
            self.origin = command.integer("from", 0, 10_000)

    def draw(self, track: Track, step: int, poses: Poses) -> None:
        """Draw the ghosts and arrows of a step; `poses` is where the robot's scene is shown."""
        last = track.known <= step
        for number, ghost in enumerate(self._ghosts):
            ghost.draw(self.qpos(track, step, number), self._path(track, number))
            judged = None if last or not self._shows_arrows else track.judged(step)
            if judged is None or number >= len(judged.wanted):
                ghost.hide_arrows()
            else:
                ghost.draw_arrows(judged.wanted[number], judged.induced[number], poses, self._shows_turns)

    def qpos(self, track: Track, step: int, number: int) -> Array | None:
        """Return the joint positions of a part's ghost at a step, in its locomotion scene; None if there is none."""
        if self.mode == "off":
            return None
        ghost = self._ghosts[number]
        if self.mode == "step":
            return ghost.one_step(track, step)
        origin = min(self.origin, track.known)
        if step < origin:
            return None
        return ghost.whole(track, origin)[step - origin]

    def distance(self, track: Track, step: int) -> dict[str, float]:
        """Return how far each part's object is a step later from where its ghost would be one step ahead [m]."""
        later = track.moment(step + 1).qpos
        apart = {ghost.name: ghost.lead(track, step) - ghost.object_position(later) for ghost in self._ghosts}
        return {name: float(np.linalg.norm(way)) for name, way in apart.items()}

    def state(self) -> dict[str, Any]:
        """Return what is drawn."""
        return {
            "ghost": {"mode": self.mode, "from": self.origin, "parts": [ghost.name for ghost in self._ghosts]},
            "arrows": {"on": self._shows_arrows, "turns": self._shows_turns},
        }

    def report(self, track: Track, step: int) -> dict[str, Any]:
        """Return the ghosts that are drawn, exactly."""
        qpos = {ghost.name: self.qpos(track, step, number) for number, ghost in enumerate(self._ghosts)}
        return {"ghost_qpos": {name: positions for name, positions in qpos.items() if positions is not None}}

    def _path(self, track: Track, number: int) -> NDArray[np.float64] | None:
        if self.mode != "whole":
            return None
        return self._ghosts[number].way(track, min(self.origin, track.known))


class _Ghost:
    """Draw the demonstration of one part, and remember what was simulated for it."""

    def __init__(
        self, server: viser.ViserServer, robot_scene: mujoco.MjModel, part: PartDemonstration, size: ArrowSize
    ) -> None:
        self.name = part.part.name
        self._part = part
        path = f"/ghost/{self.name}"
        self._server, self._path = server, f"{path}/path"
        self._view = SceneView(server, part.model, path, GHOST_LOOK)
        self._kinematics = Kinematics(part.model)
        self._lead = object_body(part.model, 0)
        self._robot_lead = object_body(robot_scene, part.part.object_index)
        self._robot_kinematics = Kinematics(robot_scene)
        self._moved = _moved_bodies(part.model, robot_scene, self._robot_lead)
        self._wanted = ActionArrows(server, f"/arrows/{self.name}/wanted", WANTED_RGB, size)
        self._induced = ActionArrows(server, f"/arrows/{self.name}/induced", INDUCED_RGB, size)
        self._version = (0, -1)
        self._steps: dict[int, Array] = {}
        self._wholes: dict[int, Array] = {}
        self._way: tuple[Array, NDArray[np.float64]] | None = None
        self._shown_path: NDArray[np.float64] | None = None
        self._line: viser.LineSegmentsHandle | None = None

    def one_step(self, track: Track, step: int) -> Array:
        """Return the ghost one step ahead of a step, `[nq]`."""
        self._forget_replaced(track)
        if step not in self._steps:
            self._steps[step] = self._part.one_step(track.moment(step))
        return self._steps[step]

    def whole(self, track: Track, origin: int) -> Array:
        """Return the demonstration that begins at a step, to the episode's end, `[K+1, nq]`."""
        self._forget_replaced(track)
        if origin not in self._wholes:
            self._wholes = {origin: self._part.run(track.moment(origin), track.steps - origin)}
        return self._wholes[origin]

    def lead(self, track: Track, step: int) -> NDArray[np.float64]:
        """Return where the object would be one step ahead [m], `[3]`."""
        return self._kinematics.poses(self.one_step(track, step)).pos[self._lead]

    def object_position(self, qpos: Array) -> NDArray[np.float64]:
        """Return where the part's object is in the robot's scene [m], `[3]`."""
        return self._robot_kinematics.poses(qpos).pos[self._robot_lead]

    def way(self, track: Track, origin: int) -> NDArray[np.float64]:
        """Return where the object is along the demonstration that begins at a step [m], `[K+1, 3]`.

        It is the same array until the demonstration is another one.
        """
        whole = self.whole(track, origin)
        if self._way is None or self._way[0] is not whole:
            self._way = whole, np.stack([self._kinematics.poses(qpos).pos[self._lead] for qpos in whole])
        return self._way[1]

    def draw(self, qpos: Array | None, path: NDArray[np.float64] | None) -> None:
        """Show the ghost and its path, or hide them."""
        self._view.root.visible = qpos is not None
        if qpos is not None:
            self._view.show(self._kinematics.poses(qpos))
        if path is not self._shown_path:
            self._draw_path(path)

    def draw_arrows(self, wanted: NDArray[np.float32], induced: NDArray[np.float32], poses: Poses, turns: bool) -> None:
        """Show what the object wanted, and what the robot made it do."""
        positions, quaternions = poses.pos[self._moved], poses.quat[self._moved]
        self._wanted.show(wanted, positions, quaternions, turns)
        self._induced.show(induced, positions, quaternions, turns)

    def hide_arrows(self) -> None:
        """Show none."""
        self._wanted.hide()
        self._induced.hide()

    def _draw_path(self, path: NDArray[np.float64] | None) -> None:
        self._shown_path = path
        if self._line is not None:
            self._line.remove()
            self._line = None
        if path is not None and len(path) > 1:
            points = np.stack([path[:-1], path[1:]], axis=1)
            self._line = self._server.scene.add_line_segments(self._path, points, WANTED_RGB, thickness=PATH_WIDTH)

    def _forget_replaced(self, track: Track) -> None:
        if self._version != (id(track), track.version):
            self._version = (id(track), track.version)
            self._steps, self._wholes = {}, {}


def object_body(model: mujoco.MjModel, index: int) -> int:
    """Return the body of an object: `object<index>` on a table, `object` in a hand."""
    numbered = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, f"object{index}")
    return numbered if numbered >= 0 else int(model.body("object").id)


def _moved_bodies(locomotion: mujoco.MjModel, robot_scene: mujoco.MjModel, lead: int) -> list[int]:
    """Return the bodies of the robot's scene that an object action moves: one, or the two ends of a chain."""
    mocaps = locomotion.body_mocapid[locomotion.body_mocapid >= 0].size
    ends = [name for body in range(robot_scene.nbody) if (name := robot_scene.body(body).name).startswith("object")]
    return [lead] if mocaps < 2 else [lead, int(robot_scene.body(max(ends)).id)]
