"""A whole epoch of the `paper` preset: which share of it is neither physics nor learning, and where that goes."""

from __future__ import annotations

import statistics
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from unittest.mock import patch

from bench_models import save_untrained_model
from bench_rows import REPETITIONS, Measured, Stopwatch, Target, row

from sldr_core.agent import DdpgAgent
from sldr_core.envs import Envs
from sldr_core.envs.simulation import Simulation
from sldr_core.presets import make_config
from sldr_core.records import Step
from sldr_core.replay.sampling import HindsightSampler
from sldr_core.streams.sldr import SldrStream
from sldr_core.training import DirectoryRecorder, cycle, loop, train
from sldr_core.training.recording import EpisodeRecording

SHORTENED = {
    "loop": {"epochs": REPETITIONS + 1, "cycles_per_epoch": 5, "test_episodes": 38, "recorded_episodes": 1},
    "replay": {"capacity": 100_000},
}
"""A tenth of the paper's epoch: of its cycles, which are whole, and of its test."""

Place = tuple[Any, str]
"""A class or module, and the name of a function of it."""

PLACES: Mapping[str, Sequence[Place]] = {
    "physics": [(Simulation, "step"), (Simulation, "forward"), (Simulation, "reset")],
    "learning": [(DdpgAgent, "update"), (DdpgAgent, "sync_targets"), (SldrStream, "reward")],
    "acting": [(DdpgAgent, "act")],
    "observing": [(Envs, "step"), (Envs, "reset")],
    "sampling": [(HindsightSampler, "sample")],
    "storing": [(cycle, "store")],
    "checking": [(cycle, "check_update"), (loop, "check_weights")],
    "files": [(DirectoryRecorder, "save_file"), (EpisodeRecording, "record")],
}
"""What is timed, by what it is called here; `observing` holds the physics that it asks for."""


@dataclass(frozen=True)
class Epoch:
    """What one epoch took, all in seconds."""

    whole: float
    parts: Mapping[str, float]

    @property
    def outside(self) -> float:
        """Share that is neither physics nor learning [%]."""
        return 100.0 * (1.0 - (self.parts["physics"] + self.parts["learning"]) / self.whole)

    def shares_outside(self) -> dict[str, float]:
        """Return where that goes [%], by name."""
        parts = {name: seconds for name, seconds in self.parts.items() if name not in ("physics", "learning")}
        parts["observing"] = max(0.0, parts["observing"] - self.parts["physics"])
        parts["else"] = max(0.0, self.whole - self.parts["physics"] - self.parts["learning"] - sum(parts.values()))
        return {name: 100.0 * seconds / self.whole for name, seconds in parts.items()}


def measure_epoch() -> Iterator[Measured]:
    """Train shortened epochs as the product does, timed from outside."""
    with tempfile.TemporaryDirectory() as name:
        epochs = run_epochs(Path(name))
    shares = [epoch.shares_outside() for epoch in epochs]
    told = {part: statistics.median(share[part] for share in shares) for part in shares[0]}
    yield row(
        "an epoch of the `paper` preset outside physics and learner",
        "%",
        [epoch.outside for epoch in epochs],
        Target("at most", 5.0),
        "FetchPush, her-sldr: " + ", ".join(f"{part} {share:.1f} %" for part, share in told.items()),
    )


def run_epochs(directory: Path, overrides: Mapping[str, Any] = SHORTENED) -> list[Epoch]:
    """Train FetchPush with her-sldr; return all epochs but the first, which begins with imports and builds."""
    watches = {name: Stopwatch() for name in PLACES}
    recorder = _EpochClock(directory / "run", watches)
    config = make_config("FetchPush", "manipulation", "her-sldr", 0, "paper", dict(overrides))
    model = save_untrained_model(directory / "locomotion.pt", "FetchPush")
    with ExitStack() as patched:
        for name, places in PLACES.items():
            for owner, function in places:
                timed = watches[name].around(getattr(owner, function))
                patched.enter_context(patch.object(owner, function, timed))
        train(config, recorder, [model], gate_waived=True)
    return recorder.epochs[1:]


class _EpochClock(DirectoryRecorder):
    """Read and reset the watches after every test."""

    def __init__(self, directory: Path, watches: Mapping[str, Stopwatch]) -> None:
        super().__init__(directory)
        self._watches = watches
        self._begun = time.perf_counter()
        self.epochs: list[Epoch] = []

    def log(self, step: Step, metrics: Mapping[str, float]) -> None:
        super().log(step, metrics)
        if "test/success_rate" in metrics:
            now = time.perf_counter()
            self.epochs.append(Epoch(now - self._begun, {name: watch.total_s for name, watch in self._watches.items()}))
            self._begun = now
            for watch in self._watches.values():
                watch.total_s = 0.0
