"""What a reward stream is, and what one is made of. `N` episodes, `T` steps, `D` observation, `G` goal, `B` batch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import torch
from torch import Tensor

from sldr_core.config import TrainConfig
from sldr_core.nets.locomotion_model import LocomotionModel
from sldr_core.nets.transitions import Transitions
from sldr_core.records import Floats


@dataclass(frozen=True)
class ObjectActions:
    """What a part wanted to do and what the robot made it do."""

    part: str
    """The part's name."""
    wanted: Tensor
    """u = nu(z, g), `[B, U]`."""
    induced: Tensor
    """w = I(z, z'), `[B, U]`."""


class Stream(Protocol):
    """Reward transitions under the goals they were given; some learn to."""

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

    def observe(self, obs: Tensor, goal: Tensor) -> None:
        """Take in new episodes: observations `[N, T+1, D]` and their original goals `[N, T+1, G]`."""
        ...

    def reward(self, batch: Transitions) -> Tensor:
        """Return rewards `[B]`; nothing is learnt from the question."""
        ...

    def object_actions(self, batch: Transitions) -> ObjectActions | None:
        """Return the actions that the rewards come from, where they come from any; nothing is learnt."""
        ...

    def learn(self, batch: Transitions) -> dict[str, Tensor]:
        """Learn from the batch of an update, after the agent did; return scalars by metric name."""
        ...

    def state_dict(self) -> dict[str, Any]:
        """Return all that the stream goes on from."""
        ...

    def load_state_dict(self, state: dict[str, Any]) -> None:
        """Go on from what `state_dict` returned."""
        ...


class FixedStream:
    """Be the part of a stream that neither stores, nor learns, nor remembers anything."""

    stored_sizes: Mapping[str, int] = {}

    def annotate(self, obs: Floats) -> Mapping[str, Floats]:
        """Store nothing."""
        return {}

    def observe(self, obs: Tensor, goal: Tensor) -> None:
        """Take in nothing."""

    def object_actions(self, batch: Transitions) -> ObjectActions | None:
        """Return nothing: the rewards come from no actions of an object."""
        return None

    def learn(self, batch: Transitions) -> dict[str, Tensor]:
        """Learn nothing."""
        return {}

    def state_dict(self) -> dict[str, Any]:
        """Return nothing."""
        return {}

    def load_state_dict(self, state: dict[str, Any]) -> None:
        """Go on from nothing."""


@dataclass(frozen=True)
class StreamOrder:
    """Say which streams are wanted, and give what they are made of."""

    config: TrainConfig
    models: Mapping[str, LocomotionModel]
    """Locomotion models by the task each was trained in."""
    generator: torch.Generator
    """Source of initial weights that no other part of a training draws from."""
    device: torch.device
    autocast: bool
