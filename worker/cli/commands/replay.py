"""`sldr replay`: simulate recorded episodes again and compare every bit."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import tyro

from sldr_core.episodes import read_episodes

DIFFERENT = 1
"""Exit code where an episode came out differently."""


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(replay, prog="sldr replay", args=list(arguments))


def replay(episodes: tyro.conf.Positional[Path]) -> int:
    """Simulate recorded episodes again from their starts and actions, and say whether the same states come out.

    Args:
        episodes: A file of recorded episodes of a training, such as episodes-epoch-0012.npz.
    """
    test = read_episodes(episodes)
    from sldr_core.training import resimulate

    differences = resimulate(test)
    for episode, difference in zip(test.episodes, differences, strict=True):
        came_out = "the same to the last bit" if difference is None else f"different from step {difference} on"
        print(f"episode {episode.index}: {episode.tag.replace('_', ' ')}, {episode.length} steps, {came_out}")
    return DIFFERENT if any(difference is not None for difference in differences) else 0
