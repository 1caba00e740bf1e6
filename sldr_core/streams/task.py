"""The environment's own reward as a stream."""

from __future__ import annotations

from torch import Tensor

from sldr_core.nets.transitions import Transitions
from sldr_core.streams.stream import FixedStream


class TaskStream(FixedStream):
    """Pass on the reward that the environment gives under the sampled goal."""

    name = "task"
    weight = 1.0

    def reward(self, batch: Transitions) -> Tensor:
        """Return the environment's reward `[B]`."""
        return batch.reward
