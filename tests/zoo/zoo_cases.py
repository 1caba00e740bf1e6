"""A locomotion model that has learnt nothing: what the zoo does with it does not depend on that."""

from __future__ import annotations

from pathlib import Path

import torch

from sldr_core.nets.locomotion_model import LocomotionModel, LocomotionNets, Measured
from sldr_core.presets import make_config

TASK = "FetchPush"


def save_model(path: Path, task: str = TASK, largest: float = 0.0) -> Path:
    """Write a locomotion model with random weights, one of them perhaps very large."""
    config = make_config(task, "locomotion", "her", 0, "smoke")
    generator = torch.Generator().manual_seed(3)
    nets = LocomotionNets(config, generator)
    for normalizer in (nets.normalizer, nets.transition_normalizer):
        normalizer.update(torch.randn(100_000, normalizer.mean.numel(), generator=generator))
    if largest:
        next(nets.inverse.parameters()).data.view(-1)[0] = largest
    LocomotionModel(nets, config, Measured(0.97, 3)).save(path)
    return path
