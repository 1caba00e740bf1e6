"""Centre and band of several seeds at each place: median with quartiles, mean with t interval, IQM with bootstrap.

Letters: `N` seeds, `G` places. Seeds without a value at a place (NaN) do not count there.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from backend.statistics.resampling import resamples_of, shares_outside, weighted_quantiles
from backend.statistics.student import t_quantile

Floats = NDArray[np.float64]

Aggregate = Literal["median", "mean", "iqm"]
"""A number for several seeds, with an interval."""

SEEDS_FOR_BAND = 3
"""Below this many seeds no band is drawn: it would look like knowledge."""

TRIMMED = 0.25
"""Share that the interquartile mean leaves out at either end."""


@dataclass(frozen=True)
class Band:
    """Hold what several seeds say together at each place."""

    centre: Floats
    """NaN where no seed has a value `[G]`."""
    low: Floats
    """Lower end of the band; NaN where fewer than `SEEDS_FOR_BAND` seeds have a value `[G]`."""
    high: Floats
    """Upper end, likewise `[G]`."""


def median_band(y: Floats, level: float) -> Band:
    """Return median and quartiles (linear between order statistics) of `[N, G]`; `level` plays no part."""
    low, centre, high = quantiles(y, (0.25, 0.5, 0.75))
    return _without_thin_bands(y, centre, low, high)


def mean_band(y: Floats, level: float) -> Band:
    """Return mean and Student's t interval, mean -+ t(n - 1) s / sqrt(n), of `[N, G]`."""
    n = np.isfinite(y).sum(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        centre = np.where(n > 0, np.nansum(y, axis=0) / n, np.nan)
        deviation = np.sqrt(np.nansum((y - centre) ** 2, axis=0) / (n - 1))
        quantile = np.array([t_quantile((1 + level) / 2, int(count) - 1) if count > 1 else np.nan for count in n])
        half = quantile * deviation / np.sqrt(n)
    return _without_thin_bands(y, centre, centre - half, centre + half)


def iqm_band(y: Floats, level: float) -> Band:
    """Return interquartile mean and percentile bootstrap over seeds of `[N, G]` (Agarwal et al., 2021)."""
    centre, low, high = (np.full(y.shape[1], np.nan) for _ in range(3))
    there = np.isfinite(y)
    # Places with the same seeds are resampled together; seeds leave rarely, so there are few such sets.
    patterns, of_place = np.unique(there, axis=1, return_inverse=True)
    for number, members in enumerate(patterns.T):
        places = np.flatnonzero(of_place.ravel() == number)
        values = y[np.ix_(members, places)]
        if len(values) == 0:
            continue
        centre[places] = interquartile_mean(values, axis=0)
        if len(values) >= SEEDS_FOR_BAND:
            low[places], high[places] = _iqm_interval(values, level)
    return Band(centre, low, high)


BANDS: Mapping[Aggregate, Callable[[Floats, float], Band]] = {
    "median": median_band,
    "mean": mean_band,
    "iqm": iqm_band,
}
"""How each aggregate is computed from `[N, G]` and a level."""


def interquartile_mean(values: Floats, axis: int = 0) -> Floats:
    """Return the mean of the middle half: the lowest and the highest quarter, rounded down, are left out."""
    count = values.shape[axis]
    cut = int(TRIMMED * count)
    middle = np.take(np.sort(values, axis=axis), np.arange(cut, count - cut), axis=axis)
    return middle.mean(axis=axis)


def quantiles(y: Floats, shares: tuple[float, ...]) -> list[Floats]:
    """Return quantiles over the finite values of each column of `[N, G]`, each `[G]`; NaN where there are none."""
    ascending = np.sort(y, axis=0)  # NaN stands last
    n = np.isfinite(y).sum(axis=0)
    if len(y) == 0:
        return [np.full(y.shape[1], np.nan) for _ in shares]
    found: list[Floats] = []
    for share in shares:
        position = share * np.maximum(n - 1, 0)
        below = np.floor(position).astype(np.int64)
        above = np.minimum(below + 1, np.maximum(n - 1, 0))
        lower, upper = (np.take_along_axis(ascending, at[None], axis=0)[0] for at in (below, above))
        found.append(lower + (position - below) * (upper - lower))
    return found


def _iqm_interval(values: Floats, level: float) -> tuple[Floats, Floats]:
    """Return the percentile interval of the IQM of `[N, G]`.

    Seeds are sorted once instead of every resample: a resample's IQM weighs each seed by how many of its copies lie in
    the middle half of the sorted draw.
    """
    resamples = resamples_of(len(values))
    order = np.argsort(values, axis=0, kind="stable").T
    ascending = np.take_along_axis(values.T, order, axis=1)
    n = len(values)
    cut = int(TRIMMED * n)
    low, high = np.empty(len(order)), np.empty(len(order))
    for place, (seeds, sorted_values) in enumerate(zip(order, ascending, strict=True)):
        copies = np.cumsum(resamples.copies[:, seeds], axis=1)
        inside = np.diff(np.clip(copies, cut, n - cut), axis=1, prepend=cut)
        replicates = inside @ sorted_values / (n - 2 * cut)
        low[place], high[place] = weighted_quantiles(replicates, resamples.weights, shares_outside(level))
    return low, high


def _without_thin_bands(y: Floats, centre: Floats, low: Floats, high: Floats) -> Band:
    thin = np.isfinite(y).sum(axis=0) < SEEDS_FOR_BAND
    return Band(centre, np.where(thin, np.nan, low), np.where(thin, np.nan, high))
