"""Bootstrap over seeds: draws with replacement, made once from a fixed seed and counted instead of repeated.

Letters: `N` seeds, `K` different resamples, `R` draws.
"""

from __future__ import annotations

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

    copies: Floats
    """How often each seed is in each different draw `[K, N]`."""
    counts: NDArray[np.int64]
    """How often each was drawn `[K]`."""


@lru_cache(maxsize=64)
def resamples_of(n: int, draws: int = RESAMPLES, seed: int = BOOTSTRAP_SEED) -> Resamples:
    """Return `draws` resamples of `n` seeds; the same for the same arguments."""
    members = np.random.default_rng([seed, n]).integers(n, size=(draws, n))
    copies = (members[:, :, None] == np.arange(n)).sum(axis=1)
    different, counts = np.unique(copies, axis=0, return_counts=True)
    return Resamples(different.astype(np.float64), counts)


def shares_outside(level: float) -> tuple[float, float]:
    """Return which shares of the draws lie below the lower and below the upper end of an interval."""
    return (1 - level) / 2, (1 + level) / 2


def weighted_quantiles(replicates: Floats, counts: NDArray[np.int64], shares: tuple[float, ...]) -> list[float]:
    """Return quantiles (inverse of the step function) of replicates `[K]` that stand for `counts` `[K]` draws."""
    order = np.argsort(replicates)
    reached = np.cumsum(counts[order])
    # A tiny slack, so that rounding of the share does not skip the draw that reaches it exactly.
    return [float(replicates[order[np.searchsorted(reached, share * reached[-1] - 1e-9)]]) for share in shares]
