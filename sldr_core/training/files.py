"""The names of a run's files, and how large each becomes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import torch

from sldr_core.config import TrainConfig
from sldr_core.episodes import MOST_FILES, episodes_file, epoch_of

METRICS_FILE = "metrics.jsonl"
REPLAY_FILE = "replay.bin"
CHECKPOINT_FILE = "checkpoint.pt"
PREVIOUS_CHECKPOINT_FILE = "checkpoint-previous.pt"
"""The one before, for when the newest turns out to be damaged."""
DAMAGED_CHECKPOINT_FILE = "checkpoint-damaged.pt"
"""One that could not be used, set aside."""
NEWEST_POLICY_FILE = "policy-newest.pt"
BEST_POLICY_FILE = "policy-best.pt"
LOCOMOTION_FILE = "locomotion.pt"

KEPT_POLICIES = 12
"""Policies that are kept while a training goes on, evenly spread over its epochs, beside that of the first epoch:
one can see it learn afterwards."""

METRICS_LINE = 8192
"""More than the line of a cycle ever takes [bytes]."""

ADAM_COPIES = 3
"""A weight is kept beside the two moments that Adam has of it."""


def kept_policy_file(epoch: int) -> str:
    """Return the name of the policy that is kept of an epoch."""
    return f"policy-epoch-{epoch:04d}.pt"


def keeps_policy(epoch: int, epochs: int) -> bool:
    """Tell whether the policy of an epoch, from 1, is kept in a training of so many: the first, then evenly."""
    return epoch == 1 or epoch % _kept_every(epochs) == 0


def is_product(name: str) -> bool:
    """Tell whether a file is a policy or a record of a training, and nothing that one goes on or takes rewards from."""
    weights = name.startswith(("policy-", "dump-")) and name.endswith(".pt")
    return weights or name == METRICS_FILE or epoch_of(name) is not None


def planned_sizes(
    config: TrainConfig,
    replay_bytes: int,
    episode_bytes: int,
    envs: Mapping[str, Any],
    learners: Sequence[Mapping[str, Any]],
) -> dict[str, int]:
    """Return how large a run's files become at most [bytes], by name.

    Args:
        config: what is trained.
        replay_bytes: size of the replay file [bytes].
        episode_bytes: size of one recorded episode [bytes].
        envs: state of the environments.
        learners: states of everything that learns, before its first update.
    """
    weights = sum(_bytes_in(learner) for learner in learners)
    recorded = min(config.loop.recorded_episodes, config.loop.test_episodes)
    # Beside those that are spread over the training stay those of the best and the newest test.
    tests = range(1, min(config.loop.epochs, MOST_FILES + 2) + 1) if recorded else ()
    checkpoint = ADAM_COPIES * weights + 2 * _bytes_in(envs)
    return {
        REPLAY_FILE: replay_bytes,
        CHECKPOINT_FILE: checkpoint,
        PREVIOUS_CHECKPOINT_FILE: checkpoint,
        "the next checkpoint": checkpoint,
        NEWEST_POLICY_FILE: weights,
        BEST_POLICY_FILE: weights,
        **{kept_policy_file(epoch): weights for epoch in _kept_policies(config.loop.epochs)},
        **({LOCOMOTION_FILE: weights} if config.phase == "locomotion" else {}),
        **{episodes_file(epoch): recorded * episode_bytes for epoch in tests},
        METRICS_FILE: METRICS_LINE * config.total_cycles,
    }


def _kept_policies(epochs: int) -> list[int]:
    every = _kept_every(epochs)
    return sorted({1, *range(every, epochs + 1, every)})


def _kept_every(epochs: int) -> int:
    return -(-epochs // KEPT_POLICIES)


def _bytes_in(value: Any) -> int:
    """Return the bytes of all tensors and arrays in nested states."""
    if isinstance(value, torch.Tensor | np.ndarray):
        return value.nbytes
    if isinstance(value, Mapping):
        return sum(_bytes_in(part) for part in value.values())
    return sum(_bytes_in(part) for part in value) if isinstance(value, list | tuple) else 0
