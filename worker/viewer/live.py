"""The view of live policies: one episode after another, toward random goals or goals that are dragged.

One policy in one, four or nine episodes side by side, or two policies from the same start.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np
import viser
from numpy.typing import ArrayLike

from sldr_core.envs import Envs, make_envs
from sldr_core.errors import BadFile
from sldr_core.training import Policy
from worker.viewer import against
from worker.viewer.commands import Command, unknown_command
from worker.viewer.display import Display, show_lanes
from worker.viewer.gizmos import GoalGizmos
from worker.viewer.judging import StreamJudge, load_models
from worker.viewer.overlay import build_against
from worker.viewer.policy_file import PolicyFile
from worker.viewer.reports import Job
from worker.viewer.simulated import Simulated
from worker.viewer.timeline import timeline
from worker.viewer.tracks import SimulatedTrack, title
from worker.viewer.transport import Transport

VERBS = ("new", "goal", "push", "gizmo", "timeline")

HARDEST_PUSH = 3.0
"""Greatest change of an object's speed along one axis [m/s]."""

_OBJECT_JOINT = re.compile(r"object\d*:joint")


def open_live(server: viser.ViserServer, job: Job) -> LiveShow:
    """Open the view of a job's policy, or of its two.

    Raises:
        BadFile: a policy cannot be used, or the second is of another task or phase.
    """
    # Every session starts elsewhere: two people who watch one run do not see the same goals.
    seed = int.from_bytes(os.urandom(4), "little")
    files = [PolicyFile(path) for path in (job.file("policy"), *job.files.get("beside", ()))]
    check_alike(files)
    lanes = int(job.request.get("episodes", 1))
    simulated = [
        Simulated(make_show_envs(file.policy, lanes, seed), lambda obs, goal, file=file: file.policy.act(obs, goal))
        for file in files
    ]
    config, envs = files[0].policy.config, simulated[0].envs
    models = load_models(config, job.files.get("locomotion", ())) if len(files) == lanes == 1 else {}
    judge = StreamJudge(config, models, envs) if models and config.phase == "manipulation" else None
    ghosts = build_against(server, config, envs.model, models) if judge is not None else None
    tracks = [SimulatedTrack(side, judge, lane) for side in simulated for lane in range(lanes)]
    display = show_lanes(server, config, envs.model, tracks, ghosts, [_side_name(file) for file in files])
    return LiveShow(files, simulated, display, GoalGizmos(server, config.task_spec))


class LiveShow:
    """Show episodes of policies that follow their files, at the pace of the transport."""

    def __init__(
        self, policy_files: list[PolicyFile], simulated: list[Simulated], display: Display, gizmos: GoalGizmos
    ) -> None:
        self._files, self._simulated, self._display, self._gizmos = policy_files, simulated, display, gizmos
        self.transport = Transport(simulated[0].steps)
        gizmos.visible = len(display.tracks) == 1

    @property
    def message(self) -> str:
        """What is shown, in one sentence."""
        first = title(self._files[0].policy.config)
        if len(self._files) == 2:
            return f"Live: {first}, {' and '.join(_side_name(file) for file in self._files)} from the same start."
        lanes = len(self._display.tracks)
        many = "" if lanes == 1 else f", {lanes} episodes side by side"
        name = self._files[0].path.name
        which = "always with the newest policy" if name == "policy-newest.pt" else name
        return f"Live: {first}{many}, {which}."

    def advance(self, wall_s: float) -> None:
        """Let time pass, simulate what is due, and draw it."""
        dragged = self._gizmos.take()
        if dragged is not None:
            self._branch(lambda envs: envs.set_goal(dragged))
        self.transport.advance(wall_s)
        if self.transport.has_ended:
            self._begin_anew()
        for side in self._simulated:
            side.simulate_to(self.transport.step + 1)
        self._display.draw(self.transport.step, self.transport.share)
        self._gizmos.show(self._display.tracks[0].moment(self.transport.step).goal)

    def obey(self, command: Command) -> dict[str, Any] | None:
        """Begin a new episode, change the goal, push an object, or tell the curves.

        Raises:
            BadCommand: there is no such command, or a value of it makes no sense.
        """
        envs = self._simulated[0].envs
        match command.do:
            case "new":
                self._begin_anew()
            case "goal":
                goal = command.vector("goal", envs.goal_size)
                self._branch(lambda envs: envs.set_goal(goal))
            case "push":
                change = command.vector("velocity", 3).clip(-HARDEST_PUSH, HARDEST_PUSH)
                joints = object_joints(envs.model)
                pushed = command.integer("object", 0, len(joints) - 1) if "object" in command.values else 0
                self._branch(lambda envs: push(envs, change, joints[pushed]))
            case "gizmo":
                self._gizmos.visible = command.flag("on")
            case "timeline":
                return timeline(self._display.tracks[0], envs, self._display.against)
            case _ if self._display.against is not None and command.do in against.VERBS:
                self._display.against.obey(command)
            case _:
                raise unknown_command(command, [*VERBS, *self._display.verbs])
        return None

    def state(self) -> dict[str, Any]:
        """Return which episode is shown, under which policies."""
        first = self._display.tracks[0]
        return {
            "timeline": first.version,
            "known": first.known,
            "policies": [
                {"name": _side_name(file), "epoch": file.policy.epoch, "problem": file.problem} for file in self._files
            ],
            "gizmo": self._gizmos.visible,
            "reached": [track.is_reached(self.transport.step) for track in self._display.tracks],
            **self._display.state(),
        }

    def report(self) -> dict[str, Any]:
        """Return the moment that is drawn."""
        return self._display.report(self.transport.step)

    def _begin_anew(self) -> None:
        for file in self._files:
            file.refresh()
        for side in self._simulated:
            side.restart()
        self.transport.seek(0)

    def _branch(self, change: Callable[[Envs], None]) -> None:
        for side in self._simulated:
            side.branch(self.transport.step, change)
        self.transport.seek(self.transport.step)


def check_alike(files: list[PolicyFile]) -> None:
    """Refuse two policies that cannot start from the same start.

    Raises:
        BadFile: they are of different tasks, phases or variants.
    """
    first, *others = (file.policy.config for file in files)
    for file, config in zip(files[1:], others, strict=True):
        if (config.task_spec, config.phase) != (first.task_spec, first.phase):
            raise BadFile(
                f"{file.path} is a policy of {config.task} ({config.phase}); only one of {first.task} ({first.phase}) "
                "can start from the same start."
            )


def make_show_envs(policy: Policy, lanes: int, seed: int) -> Envs:
    """Build the simulations that a policy was trained in, `lanes` of them."""
    config = policy.config
    return make_envs(
        config.task,
        phase=config.phase,
        num_envs=lanes,
        seed=seed,
        robot=config.scene.locomotion_robot,
        variant=config.scene.variant,
    )


def object_joints(model: mujoco.MjModel) -> list[int]:
    """Return the joints by which objects move freely, in their order; a chain moves by its first block's."""
    free = np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE).tolist()
    return [joint for joint in free if _OBJECT_JOINT.fullmatch(model.joint(joint).name)]


def push(envs: Envs, velocity: ArrayLike, joint: int) -> None:
    """Give the object that moves by a joint a sudden change of velocity [m/s], `[3]`, in every lane."""
    first = int(envs.model.jnt_dofadr[joint])
    envs.qvel[:, first : first + 3] += np.asarray(velocity)
    envs.simulation.forward()


def _side_name(file: PolicyFile) -> str:
    config, epoch = file.policy.config, file.policy.epoch
    when = "" if epoch is None else f", epoch {epoch}"
    return f"{config.method}, seed {config.seed}{when}"
