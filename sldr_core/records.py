"""The small records that pass between the parts of a training.

Shapes: `N` simulations or episodes, `T` steps of an episode, `B` batch, `D` observation, `Z` object view,
`G` goal, `A` action of the one who acts.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class Step:
    """Say how far a training is when something is logged."""

    cycle: int
    """Cycles since the start; the key of every metric."""
    epoch: int
    """Epochs begun, from 1."""
    env_steps: int
    """Control steps of training episodes."""
    episodes: int
    """Training episodes."""
    updates: int
    """Gradient updates."""
    wall_seconds: float
    """Seconds of training, over all attempts [s]."""


@dataclass(frozen=True)
class Episodes:
    """N whole episodes, as collected."""

    obs: Floats
    """Observations, `[N, T+1, D]`."""
    achieved: Floats
    """Achieved goals, `[N, T+1, G]`."""
    goal: Floats
    """The goal of each episode, `[N, G]`."""
    action: Floats
    """Actions, `[N, T, A]`."""
    extra: Mapping[str, Floats] = field(default_factory=dict)
    """Values computed once when stored, each `[N, T, ...]`, such as what the robot made the object do."""
