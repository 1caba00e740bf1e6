"""How much a seed needs until a test first reaches a threshold, and what several seeds need."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from backend.statistics.alignment import Curve


@dataclass(frozen=True)
class TimesToReach:
    """Hold what several seeds need, those that never reach the threshold counted as needing more than any other."""

    reached: int
    median: float | None
    """None if it falls on seeds that have not reached the threshold; the same holds for the quartiles."""
    low: float | None
    """First quartile."""
    high: float | None
    """Third quartile."""


def time_to_reach(curve: Curve, threshold: float) -> float | None:
    """Return where a curve first is at or above a threshold; None if it has not been (censored at its last point)."""
    there = np.flatnonzero(curve.y >= threshold)
    return float(curve.x[there[0]]) if len(there) else None


def times_to_reach(times: Sequence[float | None]) -> TimesToReach:
    """Return median and quartiles of times; between two order statistics they are interpolated linearly.

    This is exact as long as every seed that has not reached the threshold was watched longer than the quantile.
    """
    known = [np.inf if time is None else time for time in times]
    low, median, high = (_quantile(sorted(known), share) for share in (0.25, 0.5, 0.75))
    return TimesToReach(sum(time is not None for time in times), median, low, high)


def _quantile(ascending: Sequence[float], share: float) -> float | None:
    if not ascending:
        return None
    position = share * (len(ascending) - 1)
    below = int(position)
    weight = position - below
    lower = ascending[below]
    value = lower if weight == 0 else lower + weight * (ascending[below + 1] - lower)
    return float(value) if np.isfinite(value) else None
