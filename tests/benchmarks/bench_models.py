"""Locomotion models and trainings that have learnt nothing: what they cost does not depend on what they know."""

from __future__ import annotations

import tempfile
from pathlib import Path

import torch

from sldr_core.nets.locomotion_model import LocomotionModel, LocomotionNets, Measured
from sldr_core.presets import Settings, make_config
from sldr_core.training.build import Parts, build_training
from sldr_core.training.cycle import collect_random


def save_untrained_model(path: Path, task: str) -> Path:
    """Write the model of a task with the paper's nets and random weights."""
    config = make_config(task, "locomotion", "her", 0, "paper")
    LocomotionModel(LocomotionNets(config, torch.Generator().manual_seed(0)), config, Measured(1.0, 380)).save(path)
    return path


def paper_training(root: Path, task: str, method: str, settings: Settings, model: Path | None = None) -> Parts:
    """Return a robot's training of the paper's sizes, but for some settings, that has collected one cycle.

    Args:
        model: the locomotion model; one of the paper's size that has learnt nothing if None.
    """
    config = make_config(task, "manipulation", method, 0, "paper", settings)
    directory = Path(tempfile.mkdtemp(dir=root))
    models = [model or save_untrained_model(directory / "locomotion.pt", task)] if config.needs_locomotion else []
    parts = build_training(config, directory, models, gate_waived=True)
    collect_random(parts, lambda: None)
    return parts
