"""A child process whose training is a counter, so that tests see everything but the learning.

Its argument says how it behaves; what it counted is kept in `cycle.txt`, its checkpoint.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from sldr_core.config import TrainConfig
from sldr_core.errors import TrainingDiverged
from sldr_core.records import Step
from worker.child import run_child
from worker.recorder import StoreRecorder
from worker.words import StopWord

CYCLE_S = 0.02
LAST_CYCLE = {"counts": 5, "counts-far": 100, "strolls": 200, "lasts": 100_000, "saves": 100_000}
SAVE_CYCLES = 5
"""`saves` writes a checkpoint every so many cycles."""


@dataclass(frozen=True)
class Result:
    stopped: StopWord | None = None
    test_success_rate: float | None = 0.5
    best_success_rate: float | None = 1.0


def step(cycle: int) -> Step:
    return Step(cycle, epoch=1, env_steps=cycle, episodes=cycle, updates=cycle, wall_seconds=cycle * CYCLE_S)


def save(recorder: StoreRecorder, last_cycle: int) -> Result:
    """Count cycles, each leaving a byte in the replay file, with checkpoints as a training has them."""
    checkpoint, replay = recorder.directory / "checkpoint.pt", recorder.directory / "replay.bin"
    cycle = int(checkpoint.read_text()) if checkpoint.exists() else 0
    assert cycle == 0 or replay.stat().st_size >= cycle, "the replay file is older than its checkpoint"
    while cycle < last_cycle:
        cycle += 1
        time.sleep(CYCLE_S)
        with replay.open("r+b" if replay.exists() else "wb") as file:
            file.seek(cycle - 1)
            file.write(b"e")
        recorder.log(step(cycle), {"test/success_rate": 0.5})
        stop = recorder.stop_requested()
        if stop is not None or cycle % SAVE_CYCLES == 0:
            recorder.save_file("checkpoint.pt", "checkpoint", lambda path, done=cycle: write_text(path, str(done)))
        if stop is not None:
            return Result(stopped=stop)
    return Result()


def write_text(path: Path, text: str) -> None:
    path.write_text(text)


def count(recorder: StoreRecorder, last_cycle: int) -> Result:
    """Count cycles from the checkpoint on, and stop between two of them when asked."""
    checkpoint = recorder.directory / "cycle.txt"
    cycle = int(checkpoint.read_text()) if checkpoint.exists() else 0
    while cycle < last_cycle:
        cycle += 1
        time.sleep(CYCLE_S)
        recorder.log(step(cycle), {"test/success_rate": 0.5, "speed/env_steps_per_s": 10.0})
        written = checkpoint.with_suffix(".new")
        written.write_text(str(cycle))
        written.replace(checkpoint)  # A kill in the middle leaves the checkpoint before, as the real one does.
        stop = recorder.stop_requested()
        if stop is not None:
            return Result(stopped=stop)
    return Result()


def train(config: TrainConfig, recorder: StoreRecorder, locomotion_models: Sequence[Path], gate_waived: bool) -> Result:
    behaviour = sys.argv[1]
    if behaviour not in LAST_CYCLE:
        recorder.log(step(1), {"test/success_rate": 0.25})
    match behaviour:
        case "counts" | "counts-far" | "strolls" | "lasts":
            return count(recorder, LAST_CYCLE[behaviour])
        case "saves":
            return save(recorder, LAST_CYCLE[behaviour])
        case "is-deaf":
            time.sleep(3600.0)
        case "hangs-once" if not (recorder.directory / "hung").exists():
            (recorder.directory / "hung").touch()
            time.sleep(3600.0)
        case "diverges":
            raise TrainingDiverged("Metric critic/task/loss became nan; lower the learning rate.")
        case "breaks":
            raise RuntimeError("the simulation exploded\nin two lines")
        case "dies-once" if config.seed == 0 and not (recorder.directory / "died").exists():
            (recorder.directory / "died").touch()
            os.abort()
    return Result()


if __name__ == "__main__":
    sys.exit(run_child(train))
