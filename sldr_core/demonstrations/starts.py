"""Where demonstrations start and what they are to reach: each from a seed and its own number, whatever is beside it.

`N` demonstrations, `P` objects of a stack.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from sldr_core.config import TaskSpec
from sldr_core.demonstrations.placing import joint_pose
from sldr_core.envs import Envs, Start

SEED_OFFSET = 2**65
"""Demonstrations draw from generators that no training, test or evaluation uses (see `EVALUATION_SEED_OFFSET`)."""

ACTING = 1
"""Third word of generators that robots draw from while they move; zeros at the end would make no other generator."""


@dataclass(frozen=True)
class Drawn:
    """Starts of `N` demonstrations, and what the robot draws from while they run, where it moves."""

    start: Start
    rngs: tuple[np.random.Generator, ...]


class StartSource(Protocol):
    """Draw the starts of demonstrations by their numbers."""

    task: TaskSpec
    """Whose starts and goals are drawn."""
    group: int
    """Demonstrations that are one picture: the objects of a stack, each of which acts on its own; else 1."""

    def draw(self, seed: int, indices: Sequence[int]) -> Drawn:
        """Draw the starts of demonstrations `indices`; each depends on nothing but `seed` and its own index."""
        ...


class TaskStarts:
    """Draw what the task itself draws in its tests."""

    group = 1

    def __init__(self, task: TaskSpec, envs: Envs) -> None:
        self.task = task
        self._envs = envs

    def draw(self, seed: int, indices: Sequence[int]) -> Drawn:
        """Draw at most as many starts as there are simulations."""
        rngs = tuple(_generator(seed, index) for index in indices)
        return Drawn(self._envs.draw_starts(rngs), rngs)


class StackStarts:
    """Draw stacks, and give each object a scene of its own: demonstration `P k + p` is object `p` of stack `k`.

    So is a stack rewarded: the locomotion model of one object is applied to each (paper §6.4).
    """

    def __init__(self, task: TaskSpec, envs: Envs, stacks: Envs) -> None:
        """Read the scenes.

        Args:
            task: the stack's task.
            envs: simulations of the task in which the objects learn.
            stacks: one simulation of the stack's task, to draw from.
        """
        self.task = task
        self.group = len(task.parts)
        self._envs = envs
        self._stacks = stacks

    def draw(self, seed: int, indices: Sequence[int]) -> Drawn:
        """Draw the starts of single objects of stacks."""
        numbers = np.asarray(indices) // self.group
        parts = np.asarray(indices) % self.group
        alone = self._envs.draw_starts([_generator(seed, 0)])
        qpos = np.repeat(alone.qpos, len(numbers), axis=0)
        goal = np.empty((len(numbers), alone.goal.shape[1]))
        scene, first = self._stacks.model, joint_pose(self._envs.model, 0)
        for row, (number, part) in enumerate(zip(numbers.tolist(), parts.tolist(), strict=True)):
            stack = self._stacks.draw_starts([_generator(seed, number)])
            qpos[row, first] = stack.qpos[0, joint_pose(scene, part)]
            goal[row] = stack.goal[0].reshape(self.group, -1)[part]
        rngs = tuple(np.random.default_rng((seed + SEED_OFFSET, index, ACTING)) for index in indices)
        return Drawn(Start(qpos, np.repeat(alone.qvel, len(numbers), axis=0), goal), rngs)


def _generator(seed: int, index: int) -> np.random.Generator:
    return np.random.default_rng((seed + SEED_OFFSET, index))
