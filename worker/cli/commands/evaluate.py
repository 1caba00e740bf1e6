"""`sldr evaluate`: how often a trained policy succeeds."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import tyro

from sldr_core.errors import BadFile, InvalidConfig


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(evaluate, prog="sldr evaluate", args=list(arguments))


def evaluate(checkpoint: tyro.conf.Positional[Path], episodes: int = 100, seed: int = 0) -> int:
    """Measure the success of a trained policy on fresh episodes.

    Args:
        checkpoint: A policy, checkpoint or locomotion model of a training.
        episodes: Episodes to play.
        seed: Seed of their starts and goals.
    """
    if episodes < 1:
        raise InvalidConfig({"episodes": f"at least 1 is needed, got {episodes}"})
    if seed < 0:
        raise InvalidConfig({"seed": f"it must be 0 or more, got {seed}"})
    if not checkpoint.is_file():
        raise BadFile(f"There is no file {checkpoint}; give a policy, checkpoint or locomotion model of a training.")
    from sldr_core.training import evaluate as measure

    result = measure(checkpoint, episodes, seed)
    print(
        f"{result.success_rate:.1%} success: {result.successes} of {result.episodes} episodes, "
        f"95 % interval {result.low:.1%} to {result.high:.1%}"
    )
    return 0
