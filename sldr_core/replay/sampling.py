"""Hindsight experience replay: which transitions are drawn, and which goals they get (paper §3.3).

`B` batch, `T` steps of an episode, `D`, `G`, `A` as in `sldr_core.records`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sldr_core.records import Floats
from sldr_core.replay.buffer import ReplayBuffer
from sldr_core.replay.sampler import Reward, Sample, SamplerOrder


@dataclass(frozen=True)
class Draw:
    """Indices of a batch, before anything is read."""

    episode: NDArray[np.int64]
    """Slot of the episode, `[B]`."""
    step: NDArray[np.int64]
    """Step within it, 0..T-1, `[B]`."""
    goal_step: NDArray[np.int64]
    """Step whose achieved goal becomes the goal, in step+1..T; 0 where the goal stays the original, `[B]`."""

    def choose(self, chosen: NDArray[np.int64]) -> Draw:
        """Return these of its transitions alone."""
        return Draw(self.episode[chosen], self.step[chosen], self.goal_step[chosen])


def draw_steps(
    rng: np.random.Generator, batch_size: int, length: int, relabel_probability: float
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Draw steps and, for a share of them, a later step of the same episode ("future").

    Returns:
        step: uniform over 0..length-1, `[B]`.
        goal_step: uniform over step+1..length with `relabel_probability`, else 0, `[B]`.
    """
    step = rng.integers(length, size=batch_size)
    later = step + 1 + (rng.random(batch_size) * (length - step)).astype(np.int64)
    relabelled = rng.random(batch_size) < relabel_probability
    return step, np.where(relabelled, later, 0)


@dataclass(frozen=True)
class EpisodeGroups:
    """Ranks of the episodes that can be drawn, by whether anything moved in them."""

    written: int
    """Episodes stored when this was found."""
    moved: NDArray[np.int64]
    still: NDArray[np.int64]


def group_episodes(buffer: ReplayBuffer) -> EpisodeGroups:
    """Find in which episodes something moved."""
    moved = buffer.arrays["moved"][buffer.slot_of(np.arange(len(buffer)))] > 0.0
    return EpisodeGroups(buffer.written, np.flatnonzero(moved), np.flatnonzero(~moved))


def draw_ranks(
    rng: np.random.Generator, batch_size: int, groups: EpisodeGroups, still_weight: float
) -> NDArray[np.int64]:
    """Draw episodes with probability 1 if something moved in them, `still_weight` if not, up to a factor."""
    moved, still = len(groups.moved), len(groups.still)
    share = moved / (moved + still_weight * still)
    from_moved = rng.random(batch_size) < share
    position = rng.random(batch_size)
    ranks = np.empty(batch_size, dtype=np.int64)
    ranks[from_moved] = groups.moved[(position[from_moved] * moved).astype(np.int64)]
    ranks[~from_moved] = groups.still[(position[~from_moved] * still).astype(np.int64)]
    return ranks


class HindsightSampler:
    """Draw batches from a replay buffer, replacing goals in hindsight."""

    def __init__(
        self,
        buffer: ReplayBuffer,
        reward: Reward,
        relabel_probability: float,
        still_weight: float,
        rng: np.random.Generator,
    ) -> None:
        self.rng = rng
        self._buffer = buffer
        self._reward = reward
        self._relabel_probability = relabel_probability
        self._still_weight = still_weight
        self._groups = EpisodeGroups(0, np.empty(0, np.int64), np.empty(0, np.int64))
        self._length = buffer.arrays["action"].shape[1]

    def draw(self, batch_size: int) -> Draw:
        """Draw a batch's indices, with replacement."""
        if self._still_weight < 1.0:
            if self._groups.written != self._buffer.written:
                self._groups = group_episodes(self._buffer)
            rank = draw_ranks(self.rng, batch_size, self._groups, self._still_weight)
        else:
            rank = self.rng.integers(len(self._buffer), size=batch_size)
        step, goal_step = draw_steps(self.rng, batch_size, self._length, self._relabel_probability)
        return Draw(self._buffer.slot_of(rank), step, goal_step)

    def read(self, draw: Draw) -> Sample:
        """Read what was drawn."""
        return read_sample(self._buffer, draw, self._reward)

    def sample(self, batch_size: int, update: int) -> Sample:
        """Draw a batch of transitions, in the same way in every update."""
        return self.read(self.draw(batch_size))


def build_hindsight(order: SamplerOrder) -> HindsightSampler:
    """Build the sampler that a config asks for."""
    replay = order.config.replay
    return HindsightSampler(order.buffer, order.reward, replay.relabel_probability, replay.still_weight, order.rng)


def drawn_goals(buffer: ReplayBuffer, draw: Draw) -> Floats:
    """Return the goals that a draw gives its transitions, `[B, G]`."""
    relabelled = (draw.goal_step > 0)[:, None]
    later = buffer.arrays["achieved"][draw.episode, draw.goal_step]
    return np.where(relabelled, later, buffer.arrays["goal"][draw.episode])


def read_sample(buffer: ReplayBuffer, draw: Draw, reward: Reward) -> Sample:
    """Read drawn transitions, each with the goal that its draw gives it and the reward under that goal."""
    arrays = buffer.arrays
    episode, step = draw.episode, draw.step
    goal = drawn_goals(buffer, draw)
    known = ("obs", "achieved", "goal", "action", "moved")
    return Sample(
        obs=arrays["obs"][episode, step],
        next_obs=arrays["obs"][episode, step + 1],
        goal=goal,
        action=arrays["action"][episode, step],
        reward=reward(arrays["achieved"][episode, step + 1], goal),
        extra={name: array[episode, step] for name, array in arrays.items() if name not in known},
    )
