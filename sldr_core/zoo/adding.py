"""Putting a locomotion model into the zoo: halved, measured, and described in the index.

Weights are kept in half precision and loaded as float32, so what is measured is what is shipped.
"""

from __future__ import annotations

import platform
from dataclasses import replace
from functools import partial
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from tempfile import TemporaryDirectory

import torch

from sldr_core.disk import hold_lock, write_atomically
from sldr_core.nets.locomotion_model import LocomotionModel, Measured, load_locomotion_model
from sldr_core.processor import count_cores, processor_model
from sldr_core.training.evaluation import evaluate
from sldr_core.training.halving import halve
from sldr_core.zoo.index import Measurement, Origin, ZooModel, checksum, name_of, read_zoo, write_zoo

TEST_EPISODES = 380
"""Episodes that a model is measured over."""
TEST_SEED = 0
LOCK_FILE = ".lock"
PACKAGES = ("sldr", "torch", "numpy", "mujoco", "mjbatch", "gymnasium-robotics")


def add_to_zoo(source: Path, directory: Path, origin: Origin, episodes: int = TEST_EPISODES) -> ZooModel:
    """Put a locomotion model into a zoo, in place of an earlier one for the same task and scene.

    Args:
        source: the `locomotion.pt` of a run.
        directory: the zoo.
        origin: how it was trained.
        episodes: test episodes to measure it over.

    Raises:
        BadFile: the file is no usable locomotion model, or a weight is too large for half precision.
    """
    model = load_locomotion_model(source)
    read_zoo(directory)  # One that cannot be read is told of before minutes of measuring.
    directory.mkdir(parents=True, exist_ok=True)
    measured = _measure(model, source, episodes)
    name = name_of(model.config)
    path = directory / f"{name}.pt"
    # Measuring takes minutes, in which others may add theirs.
    with hold_lock(directory / LOCK_FILE):
        write_atomically(path, partial(_save_halved, replace(model, measured=_told(measured)), source))
        added = ZooModel(name, path, path.stat().st_size, checksum(path), model.config, measured, origin)
        write_zoo(directory, {**read_zoo(directory), name: added})
    return added


def origin_here(preset: str, wall_s: float | None = None, machine: str = "") -> Origin:
    """Return an origin with the versions of this installation, on this machine if no other is named."""
    return Origin(preset, _versions(), machine or describe_machine(), wall_s)


def describe_machine() -> str:
    """Return what trains here, in a few words that name nobody."""
    processor = processor_model() or platform.machine()
    gpu = torch.cuda.get_device_name() if torch.cuda.is_available() else "no GPU"
    return f"{count_cores()} cores of {processor}, {gpu}"


def _measure(model: LocomotionModel, source: Path, episodes: int) -> Measurement:
    """Run the model as it will be shipped, halved, from a file of its own."""
    with TemporaryDirectory(prefix="sldr-zoo-") as directory:
        halved = Path(directory) / "halved.pt"
        _save_halved(model, source, halved)
        result = evaluate(halved, episodes, TEST_SEED)
    return Measurement(result.successes, episodes, TEST_SEED, result.low, result.high)


def _told(measured: Measurement) -> Measured:
    return Measured(measured.success_rate, measured.episodes)


def _save_halved(model: LocomotionModel, source: Path, path: Path) -> None:
    model.save(path, change=lambda nets: halve(nets, source))


def _versions() -> dict[str, str]:
    found: dict[str, str] = {}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return found
