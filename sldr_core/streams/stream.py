"""What a reward stream is."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from torch import Tensor

from sldr_core.nets.transitions import Transitions
from sldr_core.records import Floats


class Stream(Protocol):
    """Reward transitions under the goals they were given."""

    @property
    def name(self) -> str:
        """The stream's name: `task`, `rnd`, or `sldr/<object or part>`."""
        ...

    @property
    def weight(self) -> float:
        """Weight of its critic in the actor's loss."""
        ...

    @property
    def stored_sizes(self) -> Mapping[str, int]:
        """Entries that it stores with each transition, by name."""
        ...

    def annotate(self, obs: Floats) -> Mapping[str, Floats]:
        """Return what it stores with new episodes: `[N, T, size]` by name, from observations `[N, T+1, D]`."""
        ...

    def reward(self, batch: Transitions) -> Tensor:
        """Return rewards `[B]` in [-1, 0]."""
        ...
