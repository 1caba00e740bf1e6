"""One simulated episode after another under the newest policy."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sldr_core.envs import Envs, make_envs
from sldr_core.training import Policy
from worker.viewer.policy_file import PolicyFile
from worker.viewer.scene import Kinematics, Poses


class Rollout:
    """Simulate episodes, count their successes, and remember the last two moments.

    Attributes:
        episode: number of the episode being shown, from 1.
        step: control steps of it so far.
        successes: successes among the finished episodes.
        finished: finished episodes.
        before, now: body poses at the last two control steps.
    """

    def __init__(self, envs: Envs, policy_file: PolicyFile) -> None:
        self.envs = envs
        self.policy_file = policy_file
        self.episode = self.step = self.successes = self.finished = 0
        self._kinematics = Kinematics(envs.model)
        self.restart()

    @property
    def goal(self) -> NDArray[np.float64]:
        """Where the object is to go [m], `[3]`."""
        return self._seen.goal[0, :3]

    @property
    def distance(self) -> float:
        """From the object to its goal [m]."""
        return float(np.linalg.norm(self._seen.achieved[0, :3] - self.goal))

    @property
    def is_reached(self) -> bool:
        """Whether the object is at its goal now."""
        return bool(self.envs.success(self._seen.achieved, self._seen.goal)[0])

    @property
    def is_over(self) -> bool:
        """Whether the episode has had all its steps."""
        return self.step >= self.envs.episode_length

    def restart(self) -> None:
        """Begin a new episode with a new goal, under the newest policy there is."""
        self.policy_file.refresh()
        self._seen = self.envs.reset()
        self.episode += 1
        self.step = 0
        self.before = self.now = self._poses()

    def advance(self) -> None:
        """Simulate one control step; the last one decides whether the episode was a success."""
        self._seen = self.envs.step(self.policy_file.policy.act(self._seen.obs, self._seen.goal))
        self.step += 1
        self.before, self.now = self.now, self._poses()
        if self.is_over:
            self.finished += 1
            self.successes += self.is_reached

    def _poses(self) -> Poses:
        return self._kinematics.poses(self.envs.qpos[0])


def make_rollout_envs(policy: Policy, seed: int) -> Envs:
    """Build the one simulation that a policy was trained in."""
    config = policy.config
    return make_envs(config.task, phase=config.phase, seed=seed, robot=config.scene.locomotion_robot)
