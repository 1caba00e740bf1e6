"""Bootstrap over seeds: draws with replacement, made once from a fixed seed and counted instead of repeated.

Letters: `N` seeds, `K` different resamples, `R` draws, `...` whatever else a statistic keeps.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

RESAMPLES = 2000
"""Draws of every bootstrap."""

BOOTSTRAP_SEED = 20200626
"""Seed of every bootstrap, so that the same data always have the same interval."""


@dataclass(frozen=True)
class Resamples:
    """Hold draws of `N` seeds. Equal draws stand once, with their count: five seeds have 126 different ones."""

    members: NDArray[np.int64]
    """The seeds of each different draw, ascending `[K, N]`."""
    counts: NDArray[np.int64]
    """How often each was drawn `[K]`."""


@lru_cache(maxsize=64)
def resamples_of(n: int, draws: int = RESAMPLES, seed: int = BOOTSTRAP_SEED) -> Resamples:
    """Return `draws` resamples of `n` seeds; the same for the same arguments."""
    drawn = np.sort(np.random.default_rng([seed, n]).integers(n, size=(draws, n)), axis=1)
    members, counts = np.unique(drawn, axis=0, return_counts=True)
    return Resamples(members, counts)


def bootstrap_interval(
    values: Floats, statistic: Callable[[Floats], Floats], level: float, draws: int = RESAMPLES
) -> tuple[Floats, Floats]:
    """Return the percentile interval of a statistic of the seeds.

    Args:
        values: what each seed has `[N, ...]`.
        statistic: from `[K, N, ...]` to `[K, ...]`, over the axis of the seeds.
        level: share of the draws inside, 0 to 1.

    Returns:
        Lower and upper end, each `[...]`.
    """
    resamples = resamples_of(len(values), draws)
    replicates = statistic(values[resamples.members])
    low, high = weighted_quantiles(replicates, resamples.counts, ((1 - level) / 2, (1 + level) / 2))
    return low, high


def weighted_quantiles(replicates: Floats, counts: NDArray[np.int64], shares: tuple[float, ...]) -> tuple[Floats, ...]:
    """Return quantiles (inverse of the step function) of replicates `[K, ...]` that stand for `counts` `[K]` draws."""
    order = np.argsort(replicates, axis=0, kind="stable")
    ascending = np.take_along_axis(replicates, order, axis=0)
    reached = np.cumsum(counts[order], axis=0)
    total = counts.sum()
    # A tiny slack, so that rounding of the share does not skip the draw that reaches it exactly.
    firsts = [np.argmax(reached >= share * total - 1e-9, axis=0)[None] for share in shares]
    return tuple(np.take_along_axis(ascending, first, axis=0)[0] for first in firsts)
