"""A training that was stopped, paused or killed ends with the same bits as one that was not."""

from __future__ import annotations

import json
import time
from collections.abc import Mapping
from pathlib import Path

import pytest
from small_training import (
    StoppingRecorder,
    assert_same_training,
    long_config,
    metrics_of,
    run,
    save_untrained_model,
    state_of,
    tiny_config,
)

from sldr_core.config import METHODS
from sldr_core.records import Step
from sldr_core.training import DirectoryRecorder, StopReason, train


class CancelledInTheMiddle(DirectoryRecorder):
    """Be cancelled while the third cycle collects its episodes."""

    asked = 0

    def stop_requested(self) -> StopReason | None:
        self.asked += len(metrics_of(self.directory)) == 2 if (self.directory / "metrics.jsonl").exists() else 0
        return "cancel" if self.asked > 10 else None


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("uninterrupted")
    run(long_config(), directory)
    return directory


@pytest.mark.parametrize("reason", ["shutdown", "pause"])
def test_a_stopped_training_goes_on_to_the_same_bits(reason: StopReason, uninterrupted: Path, tmp_path: Path) -> None:
    stopped = train(long_config(), StoppingRecorder(tmp_path, 7, reason))
    again = train(long_config(), StoppingRecorder(tmp_path, 6, reason))
    finished = run(long_config(), tmp_path)

    assert (stopped.finished, stopped.stopped) == (again.finished, again.stopped) == (False, reason)
    assert finished.finished
    assert_same_training(tmp_path, uninterrupted)


@pytest.mark.parametrize("method", METHODS)
def test_a_stopped_manipulation_goes_on_to_the_same_bits(method: str, tmp_path: Path) -> None:
    config, models = tiny_config("manipulation", method), (save_untrained_model(tmp_path / "model.pt"),)
    run(config, tmp_path / "whole", models)

    train(config, StoppingRecorder(tmp_path / "parts", 1, "shutdown"), models)
    run(config, tmp_path / "parts", models)

    assert_same_training(tmp_path / "parts", tmp_path / "whole")


class HurriedRecorder(DirectoryRecorder):
    """Be asked to pause at every moment."""

    def stop_requested(self) -> StopReason | None:
        return "pause"


@pytest.mark.parametrize("collecting", ["before", "beside"])
def test_a_training_paused_in_its_warm_up_goes_on_to_the_same_bits(collecting: str, tmp_path: Path) -> None:
    config = tiny_config(warmup_cycles=3, collecting=collecting)
    run(config, tmp_path / "whole")

    attempts = 1
    while not train(config, HurriedRecorder(tmp_path / "parts")).finished:
        attempts += 1

    assert attempts == config.loop.warmup_cycles + config.total_cycles
    assert_same_training(tmp_path / "parts", tmp_path / "whole")


def test_seconds_of_training_add_up_over_attempts(tmp_path: Path) -> None:
    config = tiny_config()
    train(config, StoppingRecorder(tmp_path, 2, "shutdown"))
    time.sleep(0.5)
    run(config, tmp_path)

    lines = (tmp_path / "metrics.jsonl").read_text().splitlines()
    seconds = [json.loads(line)["wall_seconds"] for line in lines]
    assert seconds == sorted(seconds)
    assert len(seconds) == config.total_cycles


def test_a_stop_asked_for_with_the_last_cycle_is_a_finish(tmp_path: Path) -> None:
    result = train(tiny_config(), StoppingRecorder(tmp_path, 4, "shutdown"))

    assert (result.finished, result.stopped) == (True, None)


def test_cancelling_ends_a_training_at_once(tmp_path: Path) -> None:
    recorder = CancelledInTheMiddle(tmp_path)

    result = train(long_config(), recorder)

    assert (result.finished, result.stopped) == (False, "cancel")
    assert len(metrics_of(tmp_path)) == 2
    assert not (tmp_path / "checkpoint.pt").exists()


def test_a_line_cut_short_by_a_crash_is_dropped(uninterrupted: Path, tmp_path: Path) -> None:
    train(long_config(), StoppingRecorder(tmp_path, 3, "shutdown"))
    with (tmp_path / "metrics.jsonl").open("a") as file:
        file.write('{"cycle": 4, "epo')

    run(long_config(), tmp_path)

    assert_same_training(tmp_path, uninterrupted)


def test_a_checkpoint_is_written_every_ten_cycles(tmp_path: Path) -> None:
    seen: dict[int, int | None] = {}

    class Watcher(DirectoryRecorder):
        def log(self, step: Step, metrics: Mapping[str, float]) -> None:
            super().log(step, metrics)
            there = (tmp_path / "checkpoint.pt").exists()
            seen[step.cycle] = state_of(tmp_path)["counters"]["cycle"] if there else None

    train(long_config(), Watcher(tmp_path))

    assert seen == {cycle: (cycle - 1) // 10 * 10 or None for cycle in range(1, 41)}
    assert state_of(tmp_path)["counters"]["cycle"] == 40
