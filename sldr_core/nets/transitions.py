"""A batch of transitions as tensors on the learner's device."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from torch import Tensor


@dataclass(frozen=True)
class Transitions:
    """B transitions under the goals they were given."""

    obs: Tensor
    """`[B, D]`."""
    next_obs: Tensor
    """`[B, D]`."""
    goal: Tensor
    """`[B, G]`."""
    action: Tensor
    """`[B, A]`."""
    reward: Tensor
    """`[B]`, of the environment."""
    extra: Mapping[str, Tensor]
    """Values stored with each transition, `[B, ...]`."""
