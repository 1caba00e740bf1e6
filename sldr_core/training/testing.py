"""The test protocol: deterministic episodes, success read at the last step (paper §6.2)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from sldr_core.envs import Envs
from sldr_core.training.rollout import Act, Check, collect_episodes
from sldr_core.training.witness import Witness

CONFIDENCE_Z = 1.959963984540054
"""Normal quantile of a two-sided 95 % interval."""


@dataclass(frozen=True)
class TestResult:
    """How a policy did."""

    successes: int
    episodes: int
    mean_final_distance: float
    """Mean distance to the goal at the end of an episode."""

    @property
    def success_rate(self) -> float:
        """Share of successful episodes."""
        return self.successes / self.episodes


def run_test(envs: Envs, act: Act, episodes: int, check: Check, witness: Witness | None = None) -> TestResult:
    """Run at least `episodes` deterministic episodes and count the first `episodes` of them, which a witness sees."""
    successes, counted, distance = 0, 0, 0.0
    while counted < episodes:
        taken = min(envs.num_envs, episodes - counted)
        collected = collect_episodes(envs, act, check, witness.begin(taken) if witness else None)
        if witness:
            witness.end(collected, taken)
        successes += int(collected.success[:taken].sum())
        distance += float(collected.final_distance[:taken].sum())
        counted += taken
    return TestResult(successes, counted, distance / counted)


def wilson_interval(successes: int, episodes: int) -> tuple[float, float]:
    """Return the 95 % Wilson score interval of a success rate."""
    rate, z2 = successes / episodes, CONFIDENCE_Z**2
    centre = (rate + z2 / (2 * episodes)) / (1 + z2 / episodes)
    half = CONFIDENCE_Z / (1 + z2 / episodes) * math.sqrt(rate * (1 - rate) / episodes + z2 / (4 * episodes**2))
    return max(0.0, min(rate, centre - half)), min(1.0, max(rate, centre + half))
