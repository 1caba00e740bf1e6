"""Which tests' episodes stay: evenly spread over the training, and never too many."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from sldr_core.episodes.files import epoch_of

MOST_FILES = 64
"""Files of a run that are kept, beside those of the best and the newest test."""


def kept_epochs(newest: int, best: int) -> frozenset[int]:
    """Return the epochs whose episodes stay after the test of epoch `newest`.

    All while there are few; then every second, every fourth and so on, from the first. So one that was dropped is
    never missed later, and a training that goes on from a checkpoint comes to the same files.

    Args:
        newest: epoch of the newest test, from 1; it stays.
        best: epoch of the best test; it stays.
    """
    stride = 1
    while -(-newest // stride) > MOST_FILES:
        stride *= 2
    return frozenset({*range(1, newest + 1, stride), best, newest})


def remove_episodes(directory: Path, newest: int, kept_epochs: Collection[int]) -> None:
    """Remove the files of tests before epoch `newest` that are not of `kept_epochs`."""
    for path in directory.iterdir():
        epoch = epoch_of(path.name)
        if epoch is not None and epoch < newest and epoch not in kept_epochs:
            path.unlink(missing_ok=True)
