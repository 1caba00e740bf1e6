"""The environment's own reward as a stream."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from torch import Tensor

from sldr_core.nets.transitions import Transitions
from sldr_core.records import Floats


@dataclass(frozen=True)
class TaskStream:
    """Pass on the reward that the environment gives under the sampled goal."""

    name: str = "task"
    weight: float = 1.0
    stored_sizes: Mapping[str, int] = field(default_factory=dict)

    def annotate(self, obs: Floats) -> Mapping[str, Floats]:
        """Store nothing."""
        return {}

    def reward(self, batch: Transitions) -> Tensor:
        """Return the environment's reward `[B]`."""
        return batch.reward
