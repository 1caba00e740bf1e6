"""Episodes as a view plays them, recorded or simulated: moments, and what was judged of each transition.

`T` steps, `P` parts that a locomotion model rewards, `U` object action, `O` objects.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from sldr_core.config import TaskSpec, TrainConfig, config_from_dict
from sldr_core.envs import TouchSense
from sldr_core.episodes import RecordedEpisode, RecordedTest
from worker.viewer.simulated import Moment, Simulated

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class Judged:
    """What was said of one transition."""

    reward: Mapping[str, float]
    """By stream."""
    value: Mapping[str, float]
    """Q of the action, by critic; empty where the policy's file holds no critics."""
    wanted: Floats
    """u, `[P, U]`; `P` is 0 without locomotion models."""
    induced: Floats
    """w, `[P, U]`."""


class Track(Protocol):
    """One episode, as far as it is known."""

    @property
    def steps(self) -> int:
        """Control steps of the whole episode, `T`."""
        ...

    @property
    def known(self) -> int:
        """The last step whose moment is known."""
        ...

    @property
    def version(self) -> int:
        """A number that changes when what was known is replaced."""
        ...

    def moment(self, step: int) -> Moment:
        """Return the episode at a step."""
        ...

    def is_reached(self, step: int) -> bool:
        """Tell whether the goal is met at a step."""
        ...

    def judged(self, step: int) -> Judged:
        """Return what was said of the transition from a step to the next, both known."""
        ...

    def touches(self, step: int) -> Mapping[str, bool]:
        """Tell which objects the robot touches at a step, by their bodies; empty without a robot."""
        ...


class RecordedTrack:
    """Play an episode of a file: every number is the file's."""

    version = 0

    def __init__(self, test: RecordedTest, episode: RecordedEpisode) -> None:
        self._origin = test.origin
        self.episode = episode
        self.config = config_from_dict(dict(test.origin.config))
        self.steps = self.known = episode.length

    def moment(self, step: int) -> Moment:
        """Return the episode at a step."""
        episode = self.episode
        return Moment(episode.qpos[step], episode.qvel[step], episode.obs[step], episode.achieved[step], episode.goal)

    def is_reached(self, step: int) -> bool:
        """Tell whether the goal is met at a step."""
        return bool(self.episode.success[step])

    def judged(self, step: int) -> Judged:
        """Return what the training's streams and critics said."""
        episode, streams = self.episode, self._origin.streams
        return Judged(
            dict(zip(streams, episode.reward[step].tolist(), strict=True)),
            dict(zip(streams, episode.value[step].tolist(), strict=True)),
            episode.wanted[step],
            episode.induced[step],
        )

    def touches(self, step: int) -> Mapping[str, bool]:
        """Tell which objects the robot touches."""
        if self.config.phase == "locomotion":
            return {}
        return dict(zip(self._origin.objects, self.episode.contact[step].tolist(), strict=True))


class Judge(Protocol):
    """Say of transitions what the training's streams would."""

    def judge(self, now: Moment, later: Moment, action: Floats) -> Judged:
        """Return what is said of the transition between two moments."""
        ...


class SimulatedTrack:
    """Play one lane of episodes that are being simulated."""

    def __init__(self, simulated: Simulated, judge: Judge | None, lane: int = 0) -> None:
        self._simulated = simulated
        self._judge = judge
        self._lane = lane
        self._sense = TouchSense(simulated.envs.model)
        self._judged: dict[int, Judged] = {}
        self._touches: dict[int, Mapping[str, bool]] = {}
        self._version = simulated.version

    @property
    def steps(self) -> int:
        """Control steps of the whole episode."""
        return self._simulated.steps

    @property
    def known(self) -> int:
        """The last step that has been simulated."""
        return self._simulated.known

    @property
    def version(self) -> int:
        """A number that changes with new episodes and branches."""
        return self._simulated.version

    def moment(self, step: int) -> Moment:
        """Return the episode at a step, which is simulated if it was not."""
        return self._simulated.moment(step, self._lane)

    def is_reached(self, step: int) -> bool:
        """Tell whether the goal is met at a step."""
        return self._simulated.is_reached(step, self._lane)

    def judged(self, step: int) -> Judged:
        """Return what the judge says; without one nothing but the task's own reward."""
        self._forget_replaced()
        if step not in self._judged:
            now, later = self.moment(step), self.moment(step + 1)
            action = self._simulated.action(step, self._lane)
            self._judged[step] = self._judge.judge(now, later, action) if self._judge else self._unjudged(later)
        return self._judged[step]

    def touches(self, step: int) -> Mapping[str, bool]:
        """Tell which objects the robot touches."""
        self._forget_replaced()
        if not self._sense.has_robot or self._simulated.envs.phase == "locomotion":
            return {}
        if step not in self._touches:
            touched = self._sense.touches(self.moment(step).qpos[None])[0]
            self._touches[step] = dict(zip(self._sense.objects, touched.tolist(), strict=True))
        return self._touches[step]

    def _unjudged(self, later: Moment) -> Judged:
        reward = float(self._simulated.envs.reward(later.achieved, later.goal))
        nothing = np.zeros((0, 0), dtype=np.float32)
        return Judged({"task": reward}, {}, nothing, nothing)

    def _forget_replaced(self) -> None:
        if self._version != self._simulated.version:
            self._version = self._simulated.version
            self._judged.clear()
            self._touches.clear()


def goal_positions(task: TaskSpec, goal: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return where the goal's markers stand [m], `[goals, 3]`; none where a body of the scene marks it."""
    if task.family == "hand":
        return np.zeros((0, 3))
    return np.asarray(goal, dtype=np.float64).reshape(-1, 3)


def title(config: TrainConfig) -> str:
    """Say who acts in a training, in a few words."""
    if config.phase == "locomotion":
        return f"the object moving itself on {config.task}"
    return f"the robot trained with {config.method} on {config.task}"
