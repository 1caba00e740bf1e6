"""What draws the batches that a training learns from, and what it is made of.

`B` batch, `T` steps of an episode, `D`, `G`, `A` as in `sldr_core.records`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from sldr_core.config import TrainConfig
from sldr_core.records import Floats
from sldr_core.replay.buffer import ReplayBuffer

Reward = Callable[[Floats, Floats], Floats]
"""Return the environment's reward `[B]` of achieved and desired goals `[B, G]`."""

Success = Callable[[Floats, Floats], NDArray[np.bool_]]
"""Tell whether achieved goals `[B, G]` meet desired ones `[B, G]`, `[B]`."""

Gaps = Callable[[Floats, Floats], NDArray[np.float64]]
"""Return distances `[..., M, N]` of goals `[..., M, G]` from others `[..., N, G]`."""


@dataclass(frozen=True)
class Sample:
    """A batch of transitions under the goals they were given."""

    obs: Floats
    """`[B, D]`."""
    next_obs: Floats
    """`[B, D]`."""
    goal: Floats
    """`[B, G]`, relabelled or original."""
    action: Floats
    """`[B, A]`."""
    reward: Floats
    """`[B]`, of the environment, under `goal`."""
    extra: dict[str, Floats]
    """Values stored with each transition, `[B, ...]`."""


class Sampler(Protocol):
    """Draw the batch of each update. All its state is its generator."""

    @property
    def rng(self) -> np.random.Generator:
        """What it draws from."""
        ...

    def sample(self, batch_size: int, update: int) -> Sample:
        """Draw a batch.

        Args:
            batch_size: `loop.batch_size`; a curriculum keeps its own share of it.
            update: updates done since the start of the training.
        """
        ...


@dataclass(frozen=True)
class SamplerOrder:
    """Say which sampler is wanted, and give what it is made of."""

    config: TrainConfig
    buffer: ReplayBuffer
    reward: Reward
    gaps: Gaps
    success: Success
    rng: np.random.Generator
