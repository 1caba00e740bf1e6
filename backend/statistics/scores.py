"""One number a run, over several tasks: interquartile mean, probability of improvement and performance profile.

Agarwal et al., "Deep Reinforcement Learning at the Edge of the Statistical Precipice", 2021, sections 4.2 and 4.3.
Intervals are percentile bootstraps; seeds are drawn anew within each task (stratified), and apart for each group.

Letters: `M` tasks, `N_m` runs of task m, `R` draws, `T` thresholds.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from backend.statistics.bands import interquartile_mean
from backend.statistics.resampling import BOOTSTRAP_SEED, RESAMPLES, count_copies

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Estimate:
    """Hold a number, or one for each threshold `[T]`, and its interval."""

    value: Floats
    low: Floats
    high: Floats


def overall_iqm(scores: Sequence[Floats], level: float) -> Estimate:
    """Return the interquartile mean of all runs of all tasks.

    Args:
        scores: one array a task, each `[N_m]`.
        level: share of the draws inside the interval.
    """
    draws = [task[_members(len(task), number, 0)] for number, task in enumerate(scores)]
    replicates = interquartile_mean(np.concatenate(draws, axis=1), axis=1)
    return _estimate(interquartile_mean(np.concatenate(scores)), replicates, level)


def probability_of_improvement(first: Sequence[Floats], second: Sequence[Floats], level: float) -> Estimate:
    """Return how probably a run of the first beats one of the second, averaged over tasks; ties count half.

    In each task it is the Mann-Whitney statistic U / (N_first N_second).

    Args:
        first: one array a task.
        second: the same tasks, in the same order.
        level: share of the draws inside the interval.
    """
    values, replicates = np.zeros(()), np.zeros(RESAMPLES)
    for number, (one, other) in enumerate(zip(first, second, strict=True)):
        wins = (one[:, None] > other) + 0.5 * (one[:, None] == other)
        values = values + wins.mean()
        of_one, of_other = _weights(len(one), number, 0), _weights(len(other), number, 1)
        replicates += np.einsum("ri,ij,rj->r", of_one, wins, of_other, optimize=True)
    return _estimate(values / len(first), replicates / len(first), level)


def performance_profile(scores: Sequence[Floats], thresholds: Floats, level: float) -> Estimate:
    """Return which share of runs scores above each threshold, averaged over tasks, each `[T]`.

    Args:
        scores: one array a task, each `[N_m]`.
        thresholds: `[T]`.
        level: share of the draws inside the interval, at each threshold by itself.
    """
    above = [(task[:, None] > thresholds).astype(np.float64) for task in scores]
    replicates = np.mean([_weights(len(task), number, 0) @ task for number, task in enumerate(above)], axis=0)
    return _estimate(np.mean([task.mean(axis=0) for task in above], axis=0), replicates, level)


@lru_cache(maxsize=256)
def _members(n: int, task: int, side: int) -> NDArray[np.int64]:
    """Return which runs of a task each draw holds `[R, N_m]`; draws of two sides do not depend on each other."""
    return np.random.default_rng([BOOTSTRAP_SEED, task, side]).integers(n, size=(RESAMPLES, n))


@lru_cache(maxsize=256)
def _weights(n: int, task: int, side: int) -> Floats:
    """Return the share of each run in each draw `[R, N_m]`."""
    return count_copies(_members(n, task, side), n) / n


def _estimate(value: Floats, replicates: Floats, level: float) -> Estimate:
    low, high = np.quantile(replicates, [(1 - level) / 2, (1 + level) / 2], axis=0)
    return Estimate(np.asarray(value), np.asarray(low), np.asarray(high))
