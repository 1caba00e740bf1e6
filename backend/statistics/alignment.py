"""Bring the curves of several seeds to common places, without inventing any of their values.

Letters: `P` points of one curve, `N` curves, `G` places of the grid.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Curve:
    """Hold one seed's curve."""

    x: Floats
    """Where it was measured, ascending `[P]`."""
    y: Floats
    """What was measured `[P]`."""
    holds: bool = False
    """Whether its last value counts on behind its end: that of a training that is done."""


@dataclass(frozen=True)
class Aligned:
    """Hold curves at common places."""

    x: Floats
    """The grid, ascending `[G]`."""
    y: Floats
    """Each curve's newest value at each place; NaN before its first, and behind its end unless it holds `[N, G]`."""
    ends: Floats
    """Where each curve was measured last; NaN if it never was `[N]`."""

    @property
    def n(self) -> NDArray[np.int64]:
        """How many curves have a value at each place `[G]`."""
        return np.isfinite(self.y).sum(axis=0)

    @property
    def measured(self) -> NDArray[np.int64]:
        """How many curves have a value at each place and have not ended before it `[G]`."""
        return (np.isfinite(self.y) & (self.x <= self.ends[:, None])).sum(axis=0)


@dataclass(frozen=True)
class Loss:
    """Say where a group of curves becomes fewer."""

    x: float
    """The last place before it does."""
    before: int
    """Curves there."""
    after: int
    """Curves at the next place."""


def align(curves: Sequence[Curve], grid: Floats) -> Aligned:
    """Read each curve on a grid as a step function: a measured value holds until the next one.

    A curve has no value before its first point, and behind its last one only if it holds.

    Args:
        curves: each with ascending `x`; of points with the same `x` the last counts.
        grid: ascending `[G]`.
    """
    y = np.full((len(curves), len(grid)), np.nan)
    ends = np.array([curve.x[-1] if len(curve.x) else np.nan for curve in curves])
    for row, curve in zip(y, curves, strict=True):
        if len(curve.x) == 0:
            continue
        newest = np.searchsorted(curve.x, grid, side="right") - 1
        inside = (newest >= 0) & (curve.holds | (grid <= curve.x[-1]))
        row[inside] = curve.y[newest[inside]]
    return Aligned(grid, y, ends)


def common_grid(curves: Sequence[Curve], most: int) -> Floats:
    """Return every place where one of the curves was measured; of more than `most`, so many spread evenly among them.

    First and last place are always kept. Values at the places kept are exact: only which places are shown is thinned.
    """
    if not curves:
        return np.empty(0)
    places = np.unique(np.concatenate([curve.x for curve in curves]))
    if len(places) <= most:
        return places
    return places[np.unique(np.round(np.linspace(0, len(places) - 1, most)).astype(np.int64))]


def find_losses(aligned: Aligned) -> list[Loss]:
    """Return where curves end while others of the group go on, whether they hold or not."""
    n = aligned.measured
    return [
        Loss(float(aligned.x[at]), int(n[at]), int(n[at + 1])) for at in np.flatnonzero(n[1:] < n[:-1]) if n[at + 1] > 0
    ]
