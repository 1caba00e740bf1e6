"""A training that is killed, wherever it is, ends with the same bits as one that was not, once it is started again."""

from __future__ import annotations

import contextlib
import json
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from small_training import assert_same_training, run, save_untrained_model, short_config

from sldr_core.config import TrainConfig, config_to_dict
from sldr_core.presets import make_config

pytestmark = pytest.mark.resume

SEED_VARIABLE = "SLDR_KILL_SEED"
"""Set it to the seed that a failed test printed, to kill at the same points again."""

KILLS = 5
"""Kills of a full test."""

SMALLER: dict[str, Any] = {
    "loop": {
        "epochs": 2,
        "cycles_per_epoch": 6,
        "episodes_per_cycle": 1,
        "updates_per_cycle": 2,
        "updates_per_sync": 2,
        "test_episodes": 1,
    },
    "agent": {"hidden_sizes": [16, 16]},
    "replay": {"capacity": 1000},
}
"""Laid over the smoke preset in the usual run: 12 cycles, a checkpoint after the tenth."""

FULL: dict[str, Any] = {"loop": {"epochs": 3, "cycles_per_epoch": 10}, "replay": {"capacity": 1000}}
"""Laid over the smoke preset: 30 cycles, a checkpoint every ten, and a replay file that begins anew."""

STEPS = 8
"""Control steps of a cycle of the short task."""


class Forked:
    """Trainings in processes of their own, which begin at once."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def start(self, config: TrainConfig, directory: Path, models: tuple[Path, ...] = (), kill: Any = None) -> int:
        """Begin a training, which ends itself by SIGKILL at `kill`, an event and its number; return its process."""
        order = {
            "config": config_to_dict(config),
            "directory": str(directory),
            "models": [str(model) for model in models],
            "kill": kill,
        }
        self._write(json.dumps(order))
        return int(self._read())

    def wait(self) -> int:
        """Return the status that the training ended with."""
        return int(self._read())

    def _write(self, line: str) -> None:
        assert self._process.stdin is not None
        self._process.stdin.write(line + "\n")
        self._process.stdin.flush()

    def _read(self) -> str:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        assert line, "the process that starts trainings has ended"
        return line


@pytest.fixture(scope="module")
def forked() -> Iterator[Forked]:
    command = [sys.executable, "forked_trainings.py"]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, cwd=Path(__file__).parent, stdin=pipe, stdout=pipe, text=True) as process:
        yield Forked(process)


@pytest.fixture
def dice() -> random.Random:
    seed = int(os.environ.get(SEED_VARIABLE, random.SystemRandom().randrange(2**32)))
    print(f"Kill points are drawn with {SEED_VARIABLE}={seed}.")
    return random.Random(seed)


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("uninterrupted")
    run(short_config(), directory)
    return directory


POINTS: dict[str, tuple[str, int, int]] = {
    "in-the-warm-up": ("step", 1, STEPS),
    "while-episodes-are-collected": ("step", STEPS + 1, 20 * STEPS),
    "while-learning": ("update", 1, 40),
    "in-the-middle-of-a-stored-episode": ("store", 1, 100),
    "in-the-middle-of-a-line-of-metrics": ("line", 1, 20),
    "in-the-middle-of-a-checkpoint": ("half:checkpoint.pt", 1, 3),
    "in-the-middle-of-the-previous-checkpoint": ("half:checkpoint-previous.pt", 1, 2),
    "before-a-checkpoint-has-its-name": ("before:checkpoint.pt", 1, 3),
    "when-a-checkpoint-has-its-name": ("after:checkpoint.pt", 1, 2),
    "in-the-middle-of-a-policy": ("half:policy-newest.pt", 1, 2),
    "in-the-middle-of-a-locomotion-model": ("half:locomotion.pt", 1, 1),
}
"""Kinds of events, and the least and greatest number of the one that is the last."""

SHORT_POINTS = {
    "in-the-warm-up",
    "in-the-middle-of-a-stored-episode",
    "in-the-middle-of-a-line-of-metrics",
    "in-the-middle-of-a-checkpoint",
    "in-the-middle-of-the-previous-checkpoint",
}
"""Those of the usual run."""


@pytest.mark.parametrize(
    "point", [pytest.param(point, marks=() if point in SHORT_POINTS else pytest.mark.slow) for point in POINTS]
)
def test_a_training_that_is_killed_there_ends_with_the_same_bits(
    point: str, forked: Forked, dice: random.Random, uninterrupted: Path, tmp_path: Path
) -> None:
    kind, least, most = POINTS[point]
    number = dice.randint(least, most)
    print(f"Killed at {kind} number {number}.")

    forked.start(short_config(), tmp_path, kill=(kind, number))
    status = forked.wait()
    run(short_config(), tmp_path)

    assert status == -signal.SIGKILL
    assert_same_training(tmp_path, uninterrupted)
    assert not list(tmp_path.glob(".*.tmp"))


@pytest.mark.parametrize("task", ["FetchPush", pytest.param("HandBlockRotate", marks=pytest.mark.slow)])
def test_a_robot_s_training_that_is_killed_at_any_moment_ends_with_the_same_bits(
    task: str, forked: Forked, dice: random.Random, tmp_path: Path
) -> None:
    killed_again_and_again(task, SMALLER, 1, forked, dice, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("task", ["FetchPush", "HandBlockRotate"])
def test_a_robot_s_training_of_smoke_size_that_is_killed_five_times_ends_with_the_same_bits(
    task: str, forked: Forked, dice: random.Random, tmp_path: Path
) -> None:
    killed_again_and_again(task, FULL, KILLS, forked, dice, tmp_path)


def killed_again_and_again(
    task: str, settings: dict[str, Any], kills: int, forked: Forked, dice: random.Random, directory: Path
) -> None:
    """Train once without a kill, and as often as it takes to be killed so often; all have to end with the same bits."""
    config = make_config(task, "manipulation", "her-sldr", 0, "smoke", settings)
    models = (save_untrained_model(directory / "model.pt", task),)
    began = time.monotonic()
    forked.start(config, directory / "whole", models)
    assert forked.wait() == 0
    whole_s = time.monotonic() - began

    killed, runs = 0, [directory / "killed-0"]
    while killed < kills:
        delay_s = dice.uniform(0.0, whole_s if kills == 1 else whole_s / 2.0)
        process = forked.start(config, runs[-1], models)
        time.sleep(delay_s)
        with contextlib.suppress(ProcessLookupError):  # it may have come to its end
            os.kill(process, signal.SIGKILL)
        status = forked.wait()
        print(f"After {delay_s:.2f} s of {whole_s:.2f} s: status {status}.")
        killed += status == -signal.SIGKILL
        if status == 0:
            runs.append(directory / f"killed-{len(runs)}")
    forked.start(config, runs[-1], models)
    assert forked.wait() == 0

    for path in runs:
        assert_same_training(path, directory / "whole")
