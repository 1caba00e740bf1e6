"""Watching test episodes while they run: what went wrong in each, and the whole course of the first ones.

`N` simulations, `T` steps, `E` episodes kept, `G` goal, `O` objects.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sldr_core.envs import Envs, Observation, TouchSense
from sldr_core.episodes import Course, Tag, tag_episodes
from sldr_core.episodes.tags import MOVED
from sldr_core.training.rollout import Collected, Watch


class Witness:
    """Watch a test, round by round; the simulations are only looked at.

    Attributes:
        tags: what went wrong in each episode of the test so far.
        courses: the first episodes, as many as were to be kept.
    """

    def __init__(self, envs: Envs, kept: int) -> None:
        self.tags: list[Tag] = []
        self.courses: list[Course] = []
        self._envs = envs
        self._sense = TouchSense(envs.model)
        self._kept = kept
        self._round: _Round | None = None

    def begin(self, taken: int) -> Watch:
        """Watch a round of which the first `taken` episodes count."""
        self._round = _Round(self._envs, self._sense, min(self._kept - len(self.courses), taken))
        return self._round.see

    def end(self, collected: Collected, taken: int) -> None:
        """Take in how the round came out."""
        assert self._round is not None
        first, tags = len(self.tags), self._round.tags()
        self.courses += self._round.courses(collected, tags, first)
        self.tags += tags[:taken]


class _Round:
    """Watch one episode in each simulation."""

    def __init__(self, envs: Envs, sense: TouchSense, kept: int) -> None:
        self._envs = envs
        self._sense = sense
        self._kept = kept
        self._robot_acts = envs.phase == "manipulation"
        count, moments = envs.num_envs, envs.episode_length + 1
        self._achieved = np.empty((count, moments, envs.goal_size))
        self._goal = np.empty((count, envs.goal_size))
        self._qpos = np.empty((kept, moments, envs.qpos.shape[1]))
        self._qvel = np.empty((kept, moments, envs.qvel.shape[1]))
        self._contact = np.zeros((kept, moments, len(sense.objects)), dtype=np.bool_)
        self._touched = np.zeros(count, dtype=np.bool_)
        self._held = np.zeros((count, len(sense.objects)), dtype=np.bool_)

    def see(self, t: int, now: Observation) -> None:
        """Take in moment `t` of every episode."""
        if t == 0:
            self._goal[:] = now.goal
            self._start = self._envs.state()
        self._achieved[:, t] = now.achieved
        self._qpos[:, t], self._qvel[:, t] = self._envs.qpos[: self._kept], self._envs.qvel[: self._kept]
        self._contact[:, t] = self._sense.touches(self._qpos[:, t])
        if self._robot_acts:
            self._look_for_touches(t)

    def tags(self) -> list[Tag]:
        """Return what went wrong in each of the `N` episodes."""
        envs, goal = self._envs, self._goal[:, None]
        return tag_episodes(
            envs.success(self._achieved, goal),
            envs.offsets(self._achieved, goal).gap,
            envs.object_positions(self._achieved),
            self._touched if self._robot_acts else None,
            self._held if self._robot_acts else None,
        )

    def courses(self, collected: Collected, tags: list[Tag], first: int) -> list[Course]:
        """Return the courses of the first `E` episodes, whose numbers begin with `first`."""
        episodes, goal = collected.episodes, self._goal[:, None]
        success, offsets = self._envs.success(self._achieved, goal), self._envs.offsets(self._achieved, goal)
        return [
            Course(
                index=first + at,
                tag=tags[at],
                start_state=self._start["simulation"][at],
                rng_state=self._start["rngs"][at],
                qpos=self._qpos[at],
                qvel=self._qvel[at],
                obs=episodes.obs[at],
                goal=self._goal[at],
                achieved=episodes.achieved[at],
                action=episodes.action[at],
                contact=self._contact[at],
                distance=offsets.distance[at],
                angle=offsets.angle[at],
                success=success[at],
            )
            for at in range(self._kept)
        ]

    def _look_for_touches(self, t: int) -> None:
        """Look where it can still matter: an object that has moved was touched, and the end shows what is held."""
        if t == self._envs.episode_length:
            self._held[:] = self._sense.touches(self._envs.qpos)
            self._touched |= np.any(self._held, axis=1)
            return
        self._touched[: self._kept] |= np.any(self._contact[:, t], axis=1)
        asked = np.flatnonzero(~self._touched & ~self._has_moved(t))
        asked = asked[asked >= self._kept]
        self._touched[asked] = np.any(self._sense.touches(self._envs.qpos[asked]), axis=1)

    def _has_moved(self, t: int) -> NDArray[np.bool_]:
        position = self._envs.object_positions(self._achieved[:, [0, t]])
        return np.any(np.linalg.norm(position[:, 1] - position[:, 0], axis=-1) > MOVED, axis=1)
