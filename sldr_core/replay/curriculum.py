"""Curriculum-guided hindsight (Fang et al., 2019): of more candidates, keep those that are diverse and near.

`C` groups, `N` candidates of a group, `P` picks of a group, `K` candidates compared for each pick, `G` goal.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sldr_core.config import CurriculumConfig
from sldr_core.replay.buffer import ReplayBuffer
from sldr_core.replay.sampler import Gaps, Sample, SamplerOrder
from sldr_core.replay.sampling import Draw, HindsightSampler, build_hindsight, drawn_goals

Numbers = NDArray[np.float64]
Indices = NDArray[np.int64]


def neighbour_gains(gaps: Numbers) -> Numbers:
    """Return how much each candidate adds to how well a selection stands for its group, `[C, N]`.

    That is the facility location of the graph in which each candidate has one edge, to its nearest neighbour, of
    similarity exp(-d^2 / mean(d)^2). As no candidate has a second edge, what one pick adds never depends on the
    others: it is the sum over those whose neighbour it is.

    Args:
        gaps: distances between the goals of a group, `[C, N, N]`.
    """
    groups, candidates = gaps.shape[:2]
    others = np.where(np.eye(candidates, dtype=np.bool_), np.inf, gaps)
    neighbour = others.argmin(axis=2)
    distance = np.take_along_axis(others, neighbour[..., None], axis=2)[..., 0]
    scale = distance.mean(axis=1, keepdims=True)
    similarity = np.exp(-np.square(np.divide(distance, scale, out=np.zeros_like(distance), where=scale > 0.0)))
    gains = np.zeros((groups, candidates))
    np.add.at(gains, (np.arange(groups)[:, None], neighbour), similarity)
    return gains


def distinct_positions(uniform: Numbers, candidates: int) -> Indices:
    """Return which of the candidates left each pick compares: all sets of K are equally likely (Floyd's sampling).

    Args:
        uniform: independent numbers in [0, 1), `[P, K, C]`.
        candidates: candidates before the first pick; each pick leaves one fewer.

    Returns:
        Different positions among those left, `[P, K, C]`.
    """
    picks, compared, _ = uniform.shape
    left = candidates - np.arange(picks)[:, None]
    positions = np.empty(uniform.shape, dtype=np.int64)
    for index in range(compared):
        last = left - compared + index
        drawn = (uniform[:, index] * (last + 1)).astype(np.int64)
        is_taken = (positions[:, :index] == drawn[:, None]).any(axis=1)
        positions[:, index] = np.where(is_taken, last, drawn)
    return positions


def greedy_picks(score: Numbers, positions: Indices) -> Indices:
    """Pick the best of the compared candidates again and again, in all groups at once.

    Args:
        score: what each candidate is worth, `[C, N]`.
        positions: what each pick compares, `[P, K, C]`, as positions among the candidates left. The place of a
            picked candidate is taken by the last one.

    Returns:
        The picked candidates, `[C, P]`; the first of equals.
    """
    groups, candidates = score.shape
    rows = np.arange(groups)
    left = np.tile(np.arange(candidates), (groups, 1))
    picked = np.empty((groups, len(positions)), dtype=np.int64)
    for pick, compared in enumerate(positions):
        best = score[rows, left[rows, compared]].argmax(axis=0)
        place = compared[best, rows]
        picked[:, pick] = left[rows, place]
        left[rows, place] = left[:, candidates - 1 - pick]
    return picked


class CurriculumSampler:
    """Draw candidates in groups with hindsight, and keep a greedy selection of each."""

    def __init__(
        self,
        candidates: HindsightSampler,
        buffer: ReplayBuffer,
        gaps: Gaps,
        config: CurriculumConfig,
        updates_per_epoch: int,
    ) -> None:
        self.rng = candidates.rng
        self._candidates = candidates
        self._buffer = buffer
        self._gaps = gaps
        self._config = config
        self._updates_per_epoch = updates_per_epoch

    def nearness(self, update: int) -> float:
        """Return the weight of nearness against diversity; it starts anew with every epoch."""
        config = self._config
        return config.nearness * (1.0 + config.nearness_growth) ** (update % self._updates_per_epoch)

    def select(self, draw: Draw, update: int) -> Draw:
        """Return the kept candidates of a draw; each group's lie together."""
        config = self._config
        goal, achieved = drawn_goals(self._buffer, draw), self._buffer.at("achieved", draw.episode, draw.step)
        groups = len(goal) // config.candidates
        grouped = goal.reshape(groups, config.candidates, -1)
        way = self._gaps(goal[:, None], achieved[:, None]).reshape(groups, config.candidates)
        score = neighbour_gains(self._gaps(grouped, grouped)) - self.nearness(update) * way
        uniform = self.rng.random((config.kept, config.examined, groups))
        picked = greedy_picks(score, distinct_positions(uniform, config.candidates))
        return draw.choose((picked + config.candidates * np.arange(groups)[:, None]).ravel())

    def sample(self, batch_size: int, update: int) -> Sample:
        """Draw `kept` transitions for each `group_size` of `batch_size`."""
        draw = self._candidates.draw(batch_size // self._config.group_size * self._config.candidates)
        return self._candidates.read(self.select(draw, update))


def build_curriculum(order: SamplerOrder) -> CurriculumSampler:
    """Build the sampler that a config asks for."""
    loop = order.config.loop
    return CurriculumSampler(
        build_hindsight(order),
        order.buffer,
        order.gaps,
        order.config.curriculum,
        loop.cycles_per_epoch * loop.updates_per_cycle,
    )
