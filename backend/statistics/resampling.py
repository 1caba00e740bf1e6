"""Bootstrap over seeds: every possible draw with its probability, or many from a fixed seed, counted not repeated.

Letters: `N` seeds, `K` different resamples, `R` draws.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations_with_replacement

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

RESAMPLES = 2000
"""Draws of a bootstrap that is too large to take every possible draw: of more than seven seeds, or several tasks."""

BOOTSTRAP_SEED = 20200626
"""Seed of every bootstrap, so that the same data always have the same interval."""


@dataclass(frozen=True)
class Resamples:
    """Hold draws of `N` seeds. Equal draws stand once, with their weight: five seeds have 126 different ones."""

    copies: Floats
    """How often each seed is in each different draw `[K, N]`."""
    weights: Floats
    """The share of each among all draws `[K]`."""


@lru_cache(maxsize=64)
def resamples_of(n: int) -> Resamples:
    """Return the resamples of `n` seeds: all possible ones with their probability if they are few, else random ones."""
    if math.comb(2 * n - 1, n) <= RESAMPLES:
        return _every_resample(n)
    members = np.random.default_rng([BOOTSTRAP_SEED, n]).integers(n, size=(RESAMPLES, n))
    different, counts = np.unique(count_copies(members, n), axis=0, return_counts=True)
    return Resamples(different.astype(np.float64), counts / RESAMPLES)


def count_copies(members: NDArray[np.int64], n: int) -> NDArray[np.int64]:
    """Return how often each of `n` seeds is in each draw `[R, N]`, of which seeds each draw holds `[R, N]`."""
    # Every draw counts in a row of its own, so that no array of R x N x N is made.
    rows = np.arange(len(members))[:, None]
    return np.bincount((members + n * rows).ravel(), minlength=n * len(members)).reshape(len(members), n)


def _every_resample(n: int) -> Resamples:
    """Return every resample with its multinomial probability, as infinitely many draws would have it."""
    copies = np.array([np.bincount(drawn, minlength=n) for drawn in combinations_with_replacement(range(n), n)])
    ways = [math.factorial(n) / math.prod(map(math.factorial, row)) for row in copies.tolist()]
    return Resamples(copies.astype(np.float64), np.array(ways) / n**n)


def shares_outside(level: float) -> tuple[float, float]:
    """Return which shares of the draws lie below the lower and below the upper end of an interval."""
    return (1 - level) / 2, (1 + level) / 2


def weighted_quantiles(replicates: Floats, weights: Floats, shares: tuple[float, ...]) -> list[float]:
    """Return quantiles (inverse of the step function) of replicates `[K]`, whose weights `[K]` sum to one."""
    order = np.argsort(replicates)
    reached = np.cumsum(weights[order])
    # A tiny slack, so that rounding does not skip the draw that reaches a share exactly.
    firsts = np.minimum(np.searchsorted(reached, np.array(shares) - 1e-9), len(order) - 1)
    return replicates[order[firsts]].tolist()
