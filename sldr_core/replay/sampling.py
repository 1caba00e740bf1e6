"""Hindsight experience replay: which transitions are drawn, and which goals they get (paper §3.3).

`B` batch, `T` steps of an episode, `D`, `G`, `A` as in `sldr_core.records`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sldr_core.config import ReplayConfig
from sldr_core.records import Floats
from sldr_core.replay.buffer import ReplayBuffer
from sldr_core.replay.sampler import Reward, Sample, SamplerOrder, Success

CANDIDATES = 4
"""Relabelled transitions looked at for each that is drawn, where those that begin at their goal count less."""


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

    def relabelled_as(self, other: Draw) -> Draw:
        """Return these transitions, but those of `other` in the places whose goal is relabelled."""
        relabelled = self.goal_step > 0
        return Draw(
            np.where(relabelled, other.episode, self.episode),
            np.where(relabelled, other.step, self.step),
            np.where(relabelled, other.goal_step, self.goal_step),
        )


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
class Split:
    """Indices of what can be drawn, in two: what is drawn fully, and what is drawn with less weight."""

    full: NDArray[np.int64]
    light: NDArray[np.int64]


def split(is_full: NDArray[np.bool_]) -> Split:
    """Return the indices of `[M]` in two."""
    return Split(np.flatnonzero(is_full), np.flatnonzero(~is_full))


def draw_split(rng: np.random.Generator, batch_size: int, parts: Split, light_weight: float) -> NDArray[np.int64]:
    """Draw indices `[B]` with replacement, with probability 1 or `light_weight`, up to a factor."""
    full, light = len(parts.full), len(parts.light)
    share = full / (full + light_weight * light)
    from_full = rng.random(batch_size) < share
    position = rng.random(batch_size)
    drawn = np.empty(batch_size, dtype=np.int64)
    drawn[from_full] = parts.full[(position[from_full] * full).astype(np.int64)]
    drawn[~from_full] = parts.light[(position[~from_full] * light).astype(np.int64)]
    return drawn


class HindsightSampler:
    """Draw batches from a replay buffer, replacing goals in hindsight."""

    def __init__(
        self, buffer: ReplayBuffer, reward: Reward, success: Success, config: ReplayConfig, rng: np.random.Generator
    ) -> None:
        self.rng = rng
        self._buffer = buffer
        self._reward = reward
        self._success = success
        self._config = config
        self._split_when = 0
        self._by_movement = split(np.empty(0, np.bool_))
        self._length = buffer.arrays["action"].shape[1]

    def draw(self, batch_size: int) -> Draw:
        """Draw a batch's indices, with replacement."""
        draw = self._draw(batch_size, self._config.relabel_probability)
        return draw if self._config.met_weight == 1.0 else draw.relabelled_as(self._draw_open(batch_size))

    def _draw(self, batch_size: int, relabel_probability: float) -> Draw:
        if self._config.still_weight == 1.0:
            rank = self.rng.integers(len(self._buffer), size=batch_size)
        else:
            rank = draw_split(self.rng, batch_size, self._episodes(), self._config.still_weight)
        step, goal_step = draw_steps(self.rng, batch_size, self._length, relabel_probability)
        return Draw(self._buffer.slot_of(rank), step, goal_step)

    def _episodes(self) -> Split:
        """Return the ranks of the episodes, those in which something moved first; found once after each storing."""
        if self._split_when != self._buffer.written:
            moved = self._buffer.arrays["moved"][self._buffer.slot_of(np.arange(len(self._buffer)))]
            self._split_when, self._by_movement = self._buffer.written, split(moved > 0.0)
        return self._by_movement

    def _draw_open(self, batch_size: int) -> Draw:
        """Draw relabelled transitions, less often those that begin at their goal: they have nothing left to do.

        Where little moves, they are nearly all, as what lies still is at every goal that it will achieve.
        """
        candidates = self._draw(CANDIDATES * batch_size, 1.0)
        achieved = self._buffer.at("achieved", candidates.episode, candidates.step)
        met = self._success(achieved, drawn_goals(self._buffer, candidates))
        return candidates.choose(draw_split(self.rng, batch_size, split(~met), self._config.met_weight))

    def read(self, draw: Draw) -> Sample:
        """Read what was drawn."""
        return read_sample(self._buffer, draw, self._reward)

    def sample(self, batch_size: int, update: int) -> Sample:
        """Draw a batch of transitions, in the same way in every update."""
        return self.read(self.draw(batch_size))


def build_hindsight(order: SamplerOrder) -> HindsightSampler:
    """Build the sampler that a config asks for."""
    return HindsightSampler(order.buffer, order.reward, order.success, order.config.replay, order.rng)


def drawn_goals(buffer: ReplayBuffer, draw: Draw) -> Floats:
    """Return the goals that a draw gives its transitions, `[B, G]`."""
    relabelled = (draw.goal_step > 0)[:, None]
    later = buffer.at("achieved", draw.episode, draw.goal_step)
    return np.where(relabelled, later, buffer.arrays["goal"].take(draw.episode, axis=0))


def read_sample(buffer: ReplayBuffer, draw: Draw, reward: Reward) -> Sample:
    """Read drawn transitions, each with the goal that its draw gives it and the reward under that goal."""
    episode, step = draw.episode, draw.step
    goal = drawn_goals(buffer, draw)
    known = ("obs", "achieved", "goal", "action", "moved")
    return Sample(
        obs=buffer.at("obs", episode, step),
        next_obs=buffer.at("obs", episode, step + 1),
        goal=goal,
        action=buffer.at("action", episode, step),
        reward=reward(buffer.at("achieved", episode, step + 1), goal),
        extra={name: buffer.at(name, episode, step) for name in buffer.arrays if name not in known},
    )
