"""Keeping what a number came from that is not finite, for a person to look at."""

from __future__ import annotations

from functools import partial

from sldr_core.config import TrainConfig, config_to_dict
from sldr_core.errors import DiskTooFull, TrainingDiverged
from sldr_core.nets.files import save_tensors
from sldr_core.training.finite import NonFinite
from sldr_core.training.recorder import Recorder

KIND = "dump"
"""What such a file calls itself; `sldr_core.nets.files.load_tensors` reads it."""


def keep_evidence(err: NonFinite, cycle: int, config: TrainConfig, recorder: Recorder) -> TrainingDiverged:
    """Write the evidence to `dump-cycle-<n>.pt` if the disk has room for it; return the error that tells of it.

    Args:
        err: what was found.
        cycle: the cycle it was found in; 0 is the warm-up.
        config: what was trained.
        recorder: where the file goes.
    """
    content = {
        "kind": KIND,
        "config": config_to_dict(config),
        "cycle": cycle,
        "culprit": err.culprit,
        "value": err.value,
        "evidence": err.evidence,
    }
    told = (
        f"{err.culprit} became {err.value} in cycle {cycle}: training was stopped; lower agent.learning_rate or check "
        "the task's numbers."
    )
    try:
        path = recorder.save_file(f"dump-cycle-{cycle}.pt", KIND, partial(save_tensors, content=content))
    except DiskTooFull:
        # More space alone would not help: it would come to the same number again.
        return TrainingDiverged(f"{told} What it came from could not be kept, as the disk is full.")
    return TrainingDiverged(f"{told} What it came from is kept in {path}.")
