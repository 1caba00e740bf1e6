"""Success and time to goal over a space of starts and goals: what is drawn, cut into cells.

`N` demonstrations; cells are counted `[L, Y, X]`: layers, rows, columns.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sldr_core.demonstrations.outcomes import CONTROL_S, NEVER
from sldr_core.envs import Start

Coordinates = Callable[[Start, NDArray[np.int64]], NDArray[np.float64]]
"""Return where starts `[N, ...]`, by their numbers `[N]`, lie in a space: x, y and layer, `[N, 3]`."""


@dataclass(frozen=True)
class Axis:
    """Cut one direction of a space into cells."""

    name: str
    unit: str
    """Of the edges, as a person reads it; empty where the cells have names."""
    edges: tuple[float, ...]
    """From the lower edge of the first cell to the upper edge of the last."""
    names: tuple[str, ...] = ()
    """What the cells are called, where numbers would say nothing."""

    @property
    def cells(self) -> int:
        """How many there are."""
        return len(self.edges) - 1

    def place(self, values: NDArray[np.float64]) -> NDArray[np.int64]:
        """Return the cells in which values lie, those beyond the edges in the outermost."""
        return np.clip(np.searchsorted(np.asarray(self.edges), values, side="right") - 1, 0, self.cells - 1)


@dataclass(frozen=True)
class Space:
    """Name what of start and goal is looked at, and cut it into cells."""

    name: str
    title: str
    """What the map is over, in words."""
    x: Axis
    y: Axis
    layer: Axis
    coordinates: Coordinates


@dataclass(frozen=True)
class CoverageMap:
    """Hold how demonstrations did, cell by cell, `[L, Y, X]`."""

    episodes: NDArray[np.int64]
    successes: NDArray[np.int64]
    median_s: NDArray[np.float64]
    """Median time to goal of the successful ones [s]; NaN where there are none."""


def cover(space: Space, start: Start, numbers: NDArray[np.int64], arrival: NDArray[np.int64]) -> CoverageMap:
    """Cut a space into cells and say how the demonstrations of each did.

    Args:
        space: what is looked at.
        start: starts and goals, `[N, ...]`.
        numbers: the demonstrations' numbers, `[N]`.
        arrival: what `steps_to_goal` says of them, `[N]`.
    """
    shape = (space.layer.cells, space.y.cells, space.x.cells)
    x, y, layer = space.coordinates(start, numbers).T
    cell = np.ravel_multi_index((space.layer.place(layer), space.y.place(y), space.x.place(x)), shape)
    arrived = arrival != NEVER
    episodes = np.bincount(cell, minlength=int(np.prod(shape)))
    successes = np.bincount(cell[arrived], minlength=episodes.size)
    median = np.full(episodes.size, np.nan)
    for one in np.flatnonzero(successes).tolist():
        median[one] = np.median(arrival[arrived & (cell == one)]) * CONTROL_S
    return CoverageMap(episodes.reshape(shape), successes.reshape(shape), median.reshape(shape))
