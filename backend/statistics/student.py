"""Quantiles of Student's t distribution, from its closed form for whole degrees of freedom."""

from __future__ import annotations

import math
from functools import lru_cache

STEPS = 200
"""Bisections of the angle; sixty already exhaust a double."""


@lru_cache(maxsize=512)
def t_quantile(probability: float, degrees: int) -> float:
    """Return t with P(T <= t) = `probability`, for one degree of freedom or more.

    Raises:
        ValueError: the probability is not between 0 and 1, or there is no degree of freedom.
    """
    if not 0.0 < probability < 1.0 or degrees < 1:
        raise ValueError(f"no t quantile for probability {probability} and {degrees} degrees of freedom")
    if probability < 0.5:
        return -t_quantile(1.0 - probability, degrees)
    wanted = 2.0 * probability - 1.0
    low, high = 0.0, math.pi / 2
    for _ in range(STEPS):
        middle = 0.5 * (low + high)
        if _share_within(middle, degrees) < wanted:
            low = middle
        else:
            high = middle
    return math.sqrt(degrees) * math.tan(0.5 * (low + high))


def _share_within(angle: float, degrees: int) -> float:
    """Return P(|T| <= sqrt(degrees) tan(angle)) (Abramowitz and Stegun, 26.7.3 and 26.7.4)."""
    sine, cosine = math.sin(angle), math.cos(angle)
    is_odd = degrees % 2 == 1
    term, total = (cosine, 0.0) if is_odd else (1.0, 0.0)
    for k in range(1 if is_odd else 0, degrees - 1, 2):
        total += term
        term *= cosine * cosine * (k + 1) / (k + 2)
    return 2.0 / math.pi * (angle + sine * total) if is_odd else sine * total
