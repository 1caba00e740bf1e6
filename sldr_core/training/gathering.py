"""Gathering the metrics of a cycle's updates."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import torch
from torch import Tensor

EXTREMES: dict[str, Callable[[Tensor, Tensor], Tensor]] = {"_min": torch.minimum, "_max": torch.maximum}
"""Metrics whose name ends so are the least or the greatest of all updates; of the others the mean is told."""


class Gathered:
    """Take the metrics of one update after the other; they stay on their device until the end."""

    def __init__(self) -> None:
        self._updates = 0
        self._values: dict[str, Tensor] = {}

    def add(self, metrics: Mapping[str, Tensor]) -> None:
        """Take the scalars of an update."""
        self._updates += 1
        for name, value in metrics.items():
            so_far = self._values.get(name)
            self._values[name] = value if so_far is None else EXTREMES.get(name[-4:], torch.add)(so_far, value)

    def close(self) -> dict[str, float]:
        """Return one number for each metric."""
        return {
            name: float(value) if name[-4:] in EXTREMES else float(value) / self._updates
            for name, value in self._values.items()
        }
