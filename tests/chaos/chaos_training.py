"""A training whose numbers anybody can work out: `python chaos_training.py CYCLES CYCLE_S`, as a worker's child.

Each cycle's number follows from the one before, so a run that lost or repeated a cycle ends with other numbers.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from sldr_core.config import TrainConfig
from sldr_core.records import Step
from worker.child import run_child
from worker.recorder import StoreRecorder
from worker.words import StopWord

MODULUS = 2**31
CHECKPOINT_CYCLES = 5
METRIC = "test/success_rate"


@dataclass(frozen=True)
class Result:
    """How a training ended."""

    stopped: StopWord | None = None
    test_success_rate: float | None = 1.0
    best_success_rate: float | None = 1.0


def following(number: int) -> int:
    """Return the number of the next cycle."""
    return (1_103_515_245 * number + 12_345) % MODULUS


def expected_curve(seed: int, cycles: int) -> list[float]:
    """Return what a run logs that nobody disturbs."""
    curve: list[float] = []
    number = seed
    for _ in range(cycles):
        number = following(number)
        curve.append(number / MODULUS)
    return curve


def train(config: TrainConfig, recorder: StoreRecorder, locomotion_models: Sequence[Path], gate_waived: bool) -> Result:
    """Go on from the checkpoint, if there is one."""
    last, cycle_s = int(sys.argv[1]), float(sys.argv[2])
    checkpoint = recorder.directory / "checkpoint.pt"
    cycle, number = json.loads(checkpoint.read_text()) if checkpoint.exists() else (0, config.seed)
    stop: StopWord | None = None
    while cycle < last and stop is None:
        time.sleep(cycle_s)
        cycle, number = cycle + 1, following(number)
        recorder.log(Step(cycle, 1, cycle, cycle, cycle, cycle * cycle_s), {METRIC: number / MODULUS})
        stop = recorder.stop_requested()
        if stop is not None or cycle % CHECKPOINT_CYCLES == 0 or cycle == last:
            state = json.dumps([cycle, number])
            recorder.save_file("checkpoint.pt", "checkpoint", lambda path, state=state: _write(path, state))
    return Result(stopped=stop if cycle < last else None)


def _write(path: Path, state: str) -> None:
    path.write_text(state)


if __name__ == "__main__":
    sys.exit(run_child(train))
