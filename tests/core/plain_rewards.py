"""What a sampler is given where rewards and goals that are met play no part."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sldr_core.records import Floats


def no_reward(achieved: Floats, goal: Floats) -> Floats:
    """Return 0 for each, `[B]`."""
    return np.zeros(len(goal), np.float32)


def never_met(achieved: Floats, goal: Floats) -> NDArray[np.bool_]:
    """Tell of each that its goal is not met, `[B]`."""
    return np.zeros(len(goal), np.bool_)
