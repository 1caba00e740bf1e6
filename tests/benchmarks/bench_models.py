"""Locomotion models that have learnt nothing: what they cost does not depend on what they know."""

from __future__ import annotations

from pathlib import Path

import torch

from sldr_core.nets.locomotion_model import LocomotionModel, LocomotionNets, Measured
from sldr_core.presets import make_config


def save_untrained_model(path: Path, task: str) -> Path:
    """Write the model of a task with the paper's nets and random weights."""
    config = make_config(task, "locomotion", "her", 0, "paper")
    LocomotionModel(LocomotionNets(config, torch.Generator().manual_seed(0)), config, Measured(1.0, 380)).save(path)
    return path
