"""Gathering the metrics of a cycle's updates."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import torch
from torch import Tensor

EXTREMES: dict[str, Callable[[Tensor], Tensor]] = {"_min": torch.amin, "_max": torch.amax}
"""Metrics whose name ends so are the least or the greatest of all updates; of the others the mean is told."""


class Gathered:
    """Take the metrics of one update after the other; they stay on their device until the end."""

    def __init__(self) -> None:
        self._names: tuple[str, ...] = ()
        self._updates: list[Tensor] = []

    def add(self, metrics: Mapping[str, Tensor]) -> None:
        """Take the scalars of an update, of the same names each time."""
        self._names = tuple(metrics)
        self._updates.append(torch.stack([value.float() for value in metrics.values()]))

    def close(self) -> dict[str, float]:
        """Return one number for each metric."""
        columns = torch.stack(self._updates).cpu().unbind(dim=1)
        return {
            name: float(EXTREMES.get(name[-4:], torch.mean)(column))
            for name, column in zip(self._names, columns, strict=True)
        }
