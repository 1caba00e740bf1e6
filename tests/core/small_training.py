"""Trainings that end within a second, and how two of them are compared."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import torch

from sldr_core.config import TASKS, Phase, TrainConfig
from sldr_core.config.tasks import FETCH_PUSH
from sldr_core.nets.locomotion_model import LocomotionModel, LocomotionNets, Measured
from sldr_core.presets import make_config
from sldr_core.records import Step
from sldr_core.training import DirectoryRecorder, StopReason, TrainResult, train
from sldr_core.training.build import Parts, build_training
from sldr_core.training.cycle import collect_random

TIMINGS = ("speed/", "progress/seconds_left")
"""Metrics that tell of the machine, not of the training."""

TINY = {
    "loop": {
        "episodes_per_cycle": 2,
        "updates_per_cycle": 2,
        "updates_per_sync": 2,
        "batch_size": 16,
        "test_episodes": 3,
    },
    "agent": {"hidden_sizes": [8, 8], "average_rate": 0.25},
    "replay": {"capacity": 160},
    "rnd": {"outputs": 8},
    "curriculum": {"group_size": 8, "candidates": 6, "kept": 3},
}
"""Laid over the smoke preset: four cycles in a fraction of a second; the replay file begins anew after 31."""

SHORT_PUSH = replace(
    FETCH_PUSH, name="ShortPush", episode_length=8, parts=(replace(FETCH_PUSH.parts[0], locomotion_task="ShortPush"),)
)
"""FetchPush with episodes that are over soon; `conftest.py` makes it known."""


class StoppingRecorder(DirectoryRecorder):
    """Ask for a stop once so many lines are logged."""

    def __init__(self, directory: Path, after: int, reason: StopReason) -> None:
        super().__init__(directory)
        self._left = after
        self._reason: StopReason = reason

    def log(self, step: Step, metrics: Mapping[str, float]) -> None:
        super().log(step, metrics)
        self._left -= 1
        if self._left == 0:
            self.request_stop(self._reason)


class CrashingRecorder(DirectoryRecorder):
    """End the training by an error nobody expected, once the line of this cycle is logged."""

    def __init__(self, directory: Path, cycle: int) -> None:
        super().__init__(directory)
        self._cycle: int | None = cycle

    def crash_after(self, cycle: int | None) -> None:
        """Let it be the line of another cycle, or none."""
        self._cycle = cycle

    def log(self, step: Step, metrics: Mapping[str, float]) -> None:
        super().log(step, metrics)
        if step.cycle == self._cycle:
            raise ConnectionAbortedError


def short_config() -> TrainConfig:
    """Return 22 cycles: two checkpoints before the last one."""
    return tiny_config(epochs=2, cycles_per_epoch=11)


def long_config() -> TrainConfig:
    """Return 40 cycles: three checkpoints before the last one, and a replay file that begins anew."""
    return tiny_config(epochs=2, cycles_per_epoch=20)


def know_short_push() -> None:
    """Make the short task known to this process."""
    TASKS[SHORT_PUSH.name] = SHORT_PUSH


def tiny_config(phase: Phase = "locomotion", method: str = "her", seed: int = 0, **loop: Any) -> TrainConfig:
    """Return a config of the smallest training, with these settings of its loop."""
    overrides = {**TINY, "loop": {**TINY["loop"], **loop}}
    return make_config(SHORT_PUSH.name, phase, method, seed, "smoke", overrides)


def run(config: TrainConfig, directory: Path, models: tuple[Path, ...] = ()) -> TrainResult:
    """Train in `directory`, going on from its checkpoint."""
    return train(config, DirectoryRecorder(directory), models)


def collected_parts(config: TrainConfig, directory: Path, models: tuple[Path, ...] = ()) -> Parts:
    """Return a training that has collected its first episodes and learnt nothing."""
    parts = build_training(config, directory, models)
    collect_random(parts, lambda: None)
    return parts


def save_untrained_model(path: Path, task: str = SHORT_PUSH.name, spoil: float = 0.0) -> Path:
    """Write a locomotion model that has learnt nothing; `spoil` is added to every weight of its critic."""
    config = make_config(task, "locomotion", "her", 0, "smoke", {"agent": TINY["agent"]})
    generator = torch.Generator().manual_seed(3)
    nets = LocomotionNets(config, generator)
    for normalizer in (nets.normalizer, nets.transition_normalizer):
        normalizer.update(torch.randn(100, normalizer.mean.numel(), generator=generator))
    for weight in nets.critic.parameters():
        weight.data += spoil
    LocomotionModel(nets, config, Measured(0.97, 3)).save(path)
    return path


def contents_of(directory: Path) -> dict[str, bytes]:
    """Return every file of a directory."""
    return {path.name: path.read_bytes() for path in directory.iterdir()}


def metrics_of(directory: Path) -> list[dict[str, Any]]:
    """Return every logged line, without what depends on the clock."""
    lines = [json.loads(line) for line in (directory / "metrics.jsonl").read_text().splitlines()]
    for line in lines:
        line.pop("wall_seconds")
        line["metrics"] = {name: value for name, value in line["metrics"].items() if not name.startswith(TIMINGS)}
    return lines


def state_of(directory: Path) -> dict[str, Any]:
    """Return everything in the checkpoint, as plain values, without what depends on the clock."""
    content = torch.load(directory / "checkpoint.pt", weights_only=True)
    content["counters"].pop("wall_seconds")
    return _plain(content)


def assert_same_training(first: Path, second: Path) -> None:
    """Compare metrics, checkpoints and replay files of two runs, bit for bit."""
    assert metrics_of(first) == metrics_of(second)
    ours, theirs = state_of(first), state_of(second)
    assert {name for name in ours if ours[name] != theirs[name]} == set()
    assert (first / "replay.bin").read_bytes() == (second / "replay.bin").read_bytes()


def _plain(value: Any) -> Any:
    if isinstance(value, torch.Tensor):
        return (str(value.dtype), value.tolist())
    if isinstance(value, dict):
        return {name: _plain(part) for name, part in value.items()}
    return [_plain(part) for part in value] if isinstance(value, list | tuple) else value
