"""Measuring a saved policy on episodes of its own."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from sldr_core.envs import make_envs
from sldr_core.errors import InvalidConfig
from sldr_core.training.compute import resolve_compute
from sldr_core.training.policy import load_policy
from sldr_core.training.testing import run_test, wilson_interval

EVALUATION_SEED_OFFSET = 2**64
"""Evaluations draw from generators that no training and no test of a training uses.

A generator of (seed, number) is made of the 32-bit words of both, one after the other: with an offset of 2**32
simulation 0 of an evaluation would be simulation 1 of the training.
"""

MAX_SIMULATIONS = 38
"""Episodes run side by side."""


@dataclass(frozen=True)
class EvaluationResult:
    """How a policy did, with the 95 % Wilson interval of its success rate."""

    task: str
    phase: str
    method: str
    successes: int
    episodes: int
    success_rate: float
    low: float
    high: float
    mean_final_distance: float


def evaluate(path: Path, episodes: int, seed: int) -> EvaluationResult:
    """Run a saved policy's deterministic actor.

    Args:
        path: a policy file, a checkpoint or a locomotion model.
        episodes: episodes to run.
        seed: seed of starts and goals.

    Raises:
        BadFile: the file holds no usable policy.
        InvalidConfig: there is nothing to run, or no such seed.
    """
    if episodes < 1 or seed < 0:
        raise InvalidConfig({"episodes" if episodes < 1 else "seed": "is too low; give 1 episode and seed 0 or more."})
    policy = load_policy(path)
    config = policy.config
    # The policy acts on the processor: the file may come from a machine with a GPU.
    compute = resolve_compute(replace(config.compute, device="cpu"))
    envs = make_envs(
        config.task,
        config.phase,
        num_envs=min(episodes, MAX_SIMULATIONS),
        seed=seed + EVALUATION_SEED_OFFSET,
        threads=compute.threads,
        robot=config.scene.locomotion_robot,
        testing=True,
        variant=config.scene.variant,
    )
    result = run_test(envs, policy.act, episodes, check=lambda: None)
    low, high = wilson_interval(result.successes, result.episodes)
    return EvaluationResult(
        task=config.task,
        phase=config.phase,
        method=config.method,
        successes=result.successes,
        episodes=result.episodes,
        success_rate=result.success_rate,
        low=low,
        high=high,
        mean_final_distance=result.mean_final_distance,
    )
