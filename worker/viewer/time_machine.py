"""The time machine: one start and one goal, under every policy that was kept while training."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import viser
from numpy.typing import NDArray

from sldr_core.envs import Envs
from sldr_core.training import Policy, load_policy
from worker.viewer.camera import find_camera
from worker.viewer.commands import Command
from worker.viewer.judging import StreamJudge, load_models
from worker.viewer.live import make_show_envs
from worker.viewer.overlay import build_against
from worker.viewer.page import look_through
from worker.viewer.reports import Job
from worker.viewer.simulated import Array, Simulated
from worker.viewer.stage import PathLine, Stage, walked_lines
from worker.viewer.timeline import timeline
from worker.viewer.tracks import SimulatedTrack, title
from worker.viewer.transport import Transport

VERBS = ("epoch", "new", "timeline")

FIRST_RGB, LAST_RGB = np.array([253.0, 231.0, 37.0]), np.array([68.0, 1.0, 84.0])
"""Paths go from yellow, the oldest policy, to dark violet, the newest: apart in brightness, too."""

PATH_WIDTH = 0.0035
"""Width of a policy's path [m]."""

PATH_EVERY = 5
"""Paths are drawn again after so many simulated steps."""


def open_time_machine(server: viser.ViserServer, job: Job) -> TimeMachineShow:
    """Open the time machine of a job's policies.

    Raises:
        BadFile: a policy or a locomotion model cannot be used.
    """
    policies = distinct_epochs([load_policy(path) for path in job.files["policies"]])
    config = policies[-1].config
    seed = int.from_bytes(os.urandom(4), "little")
    simulated = Simulated(
        make_show_envs(policies[-1], len(policies), seed),
        act_each(policies),
        one_start_for_all(make_show_envs(policies[-1], 1, seed)),
    )
    model = simulated.envs.model
    models = load_models(config, job.files.get("locomotion", ())) if config.phase == "manipulation" else {}
    judge = StreamJudge(config, models, simulated.envs) if models else None
    tracks = [SimulatedTrack(simulated, judge, lane) for lane in range(len(policies))]
    look_through(server, find_camera(config.task_spec, config.phase))
    stage = Stage(server, config.task_spec, model, build_against(server, config, model, models))
    return TimeMachineShow(server, policies, simulated, tracks, stage)


class TimeMachineShow:
    """Play the episode of one policy, with the paths of all; another policy is a jump through training."""

    def __init__(
        self,
        server: viser.ViserServer,
        policies: Sequence[Policy],
        simulated: Simulated,
        tracks: Sequence[SimulatedTrack],
        stage: Stage,
    ) -> None:
        self._policies, self._simulated, self._tracks, self._stage = policies, simulated, tracks, stage
        self._at = len(policies) - 1
        self._lines = [
            PathLine(server, f"/policies/{number}", colour, PATH_WIDTH)
            for number, colour in enumerate(path_colours(len(policies)))
        ]
        self.transport = Transport(simulated.steps)
        self.transport.is_looping = True

    @property
    def message(self) -> str:
        """What is shown, in one sentence."""
        return f"Time machine: {title(self._policies[0].config)}, {len(self._policies)} policies from one start."

    def advance(self, wall_s: float) -> None:
        """Let time pass, simulate a step ahead, and draw."""
        self.transport.advance(wall_s)
        step = self.transport.step
        self._simulated.simulate_to(max(self._simulated.known + 1, step + 1))
        self._stage.draw(self._tracks[self._at], step, self.transport.share)
        self._draw_paths()

    def obey(self, command: Command) -> dict[str, Any] | None:
        """Go to another policy, draw a new start, or tell the curves of the policy shown.

        Raises:
            BadCommand: there is no such command, or a value of it makes no sense.
        """
        match command.do:
            case "epoch":
                self._at = command.integer("at", 0, len(self._policies) - 1)
            case "new":
                self._simulated.restart()
                self.transport.seek(0)
            case "timeline":
                return timeline(self._tracks[self._at], self._simulated.envs, self._stage.against)
            case _:
                self._stage.obey(command, VERBS)
        return None

    def state(self) -> dict[str, Any]:
        """Return which policies there are, and how each did."""
        known = self._simulated.known
        ended = known >= self._simulated.steps
        return {
            "timeline": self._simulated.version * len(self._policies) + self._at,
            "known": known,
            "epochs": [policy.epoch for policy in self._policies],
            "at": self._at,
            "successes": [track.is_reached(known) if ended else None for track in self._tracks],
            "reached": [self._tracks[self._at].is_reached(self.transport.step)],
            **self._stage.state(),
        }

    def report(self) -> dict[str, Any]:
        """Return the moment that is drawn."""
        return self._stage.report(self._tracks[self._at], self.transport.step)

    def _draw_paths(self) -> None:
        known = self._simulated.known
        until = known if known >= self._simulated.steps else known - known % PATH_EVERY
        task = self._policies[0].config.task_spec
        for line, track in zip(self._lines, self._tracks, strict=True):
            version = (self._simulated.version, until)
            if line.version != version:
                achieved = np.stack([track.moment(step).achieved for step in range(until + 1)])
                line.show(walked_lines(task, achieved), version)


def distinct_epochs(policies: Sequence[Policy]) -> list[Policy]:
    """Return policies of different epochs in the order of training; of one epoch the last is kept."""
    by_epoch = {-1 if policy.epoch is None else policy.epoch: policy for policy in policies}
    return [by_epoch[epoch] for epoch in sorted(by_epoch)]


def act_each(policies: Sequence[Policy]) -> Callable[[Array, Array], NDArray[np.float32]]:
    """Return what lets policy `i` act in lane `i`, as if it were alone."""

    def act(obs: Array, goal: Array) -> NDArray[np.float32]:
        lanes = range(len(policies))
        return np.concatenate([policies[lane].act(obs[lane : lane + 1], goal[lane : lane + 1]) for lane in lanes])

    return act


def one_start_for_all(source: Envs) -> Callable[[Envs], object]:
    """Return what puts every lane to one and the same new start, drawn in a simulation of its own."""

    def begin(envs: Envs) -> None:
        source.reset()
        state = source.state()
        lanes = envs.num_envs
        envs.restore(
            {
                "simulation": np.repeat(state["simulation"], lanes, axis=0),
                "goal": np.repeat(state["goal"], lanes, axis=0),
                "rngs": state["rngs"] * lanes,
            }
        )

    return begin


def path_colours(count: int) -> list[tuple[int, int, int]]:
    """Return a colour for each policy, from the oldest to the newest."""
    shares = np.linspace(0.0, 1.0, count) if count > 1 else np.ones(1)
    mixed = [FIRST_RGB + share * (LAST_RGB - FIRST_RGB) for share in shares]
    return [(round(red), round(green), round(blue)) for red, green, blue in mixed]
