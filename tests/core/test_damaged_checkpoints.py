"""A damaged checkpoint costs a training the cycles since the one before, never the run; and what happened is told."""

from __future__ import annotations

import logging
from pathlib import Path

import pytest
import torch
from small_training import (
    CrashingRecorder,
    StoppingRecorder,
    assert_same_training,
    contents_of,
    long_config,
    run,
    short_config,
    tiny_config,
)

from sldr_core.errors import BadFile, DirectoryInUse
from sldr_core.training import train
from sldr_core.training.directory import alone_in

DAMAGES = {
    "cut-short": lambda path: path.write_bytes(path.read_bytes()[:-1000]),
    "empty": lambda path: path.write_bytes(b""),
    "gone": lambda path: path.unlink(),
    "a-part-lost": lambda path: torch.save(
        {name: part for name, part in torch.load(path, weights_only=True).items() if name != "agent"}, path
    ),
}


def cycle_of(path: Path) -> int:
    return torch.load(path, weights_only=True)["counters"]["cycle"]


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("uninterrupted")
    run(short_config(), directory)
    return directory


@pytest.fixture
def stopped(tmp_path: Path) -> Path:
    """Return the directory of a training that was stopped after cycle 13, with checkpoints of cycles 10 and 13."""
    train(short_config(), StoppingRecorder(tmp_path, 13, "shutdown"))
    return tmp_path


def test_the_previous_checkpoint_is_kept_beside_the_newest(stopped: Path) -> None:
    assert (cycle_of(stopped / "checkpoint.pt"), cycle_of(stopped / "checkpoint-previous.pt")) == (13, 10)


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_training_goes_on_from_the_previous_checkpoint_to_the_same_bits(
    damage: str, stopped: Path, uninterrupted: Path, caplog: pytest.LogCaptureFixture
) -> None:
    newest = stopped / "checkpoint.pt"
    DAMAGES[damage](newest)
    damaged = newest.read_bytes() if newest.exists() else None

    run(short_config(), stopped)

    (told,) = [record.getMessage() for record in caplog.records if record.levelno == logging.WARNING]
    assert f"{newest}" in told
    assert told.endswith(f"Going on from {stopped / 'checkpoint-previous.pt'}, after cycle 10.")
    assert_same_training(stopped, uninterrupted)
    if damaged is not None:
        assert (stopped / "checkpoint-damaged.pt").read_bytes() == damaged


def test_a_recorder_that_is_used_again_has_no_line_twice(tmp_path: Path, uninterrupted: Path) -> None:
    recorder = CrashingRecorder(tmp_path, 13)
    with pytest.raises(ConnectionAbortedError):
        train(short_config(), recorder)
    recorder.crash_after(None)

    train(short_config(), recorder)

    assert_same_training(tmp_path, uninterrupted)


def test_the_replay_file_serves_the_previous_checkpoint_until_the_last_moment(
    tmp_path: Path,
) -> None:
    run(long_config(), tmp_path / "whole")
    killed = tmp_path / "killed"
    with pytest.raises(ConnectionAbortedError):
        train(long_config(), CrashingRecorder(killed, 39))
    assert cycle_of(killed / "checkpoint-previous.pt") == 20
    (killed / "checkpoint.pt").write_bytes(b"damaged")

    run(long_config(), killed)

    assert_same_training(killed, tmp_path / "whole")


def test_a_damaged_checkpoint_never_takes_the_place_of_the_previous_one(stopped: Path) -> None:
    (stopped / "checkpoint.pt").write_bytes(b"damaged")

    train(short_config(), StoppingRecorder(stopped, 1, "shutdown"))

    assert (cycle_of(stopped / "checkpoint.pt"), cycle_of(stopped / "checkpoint-previous.pt")) == (11, 10)


def test_a_whole_checkpoint_is_used_without_a_word(stopped: Path, caplog: pytest.LogCaptureFixture) -> None:
    run(short_config(), stopped)

    assert caplog.records == []


def test_two_damaged_checkpoints_are_told_and_nothing_is_touched(stopped: Path) -> None:
    for name in ("checkpoint.pt", "checkpoint-previous.pt"):
        (stopped / name).write_bytes(b"damaged")
    before = contents_of(stopped)

    with pytest.raises(
        BadFile, match=r"checkpoint\.pt is corrupt or no file of ours; remove every checkpoint of this directory"
    ):
        run(short_config(), stopped)

    assert contents_of(stopped) == before


def test_a_checkpoint_from_before_a_setting_was_added_is_gone_on_from(stopped: Path, uninterrupted: Path) -> None:
    content = torch.load(stopped / "checkpoint.pt", weights_only=True)
    assert content["config"]["agent"].pop("lowest_return") == 0.0, "it has to have its default"
    torch.save({**content, "config_hash": "0" * 16}, stopped / "checkpoint.pt")

    run(short_config(), stopped)

    assert_same_training(stopped, uninterrupted)


def test_another_config_is_refused_whatever_the_previous_checkpoint_is(stopped: Path) -> None:
    other = tiny_config(epochs=2, cycles_per_epoch=11, updates_per_cycle=3)
    before = contents_of(stopped)

    with pytest.raises(BadFile, match="was made by another config"):
        run(other, stopped)

    assert contents_of(stopped) == before


def test_temporary_files_of_killed_processes_are_removed_and_those_of_living_ones_stay(tmp_path: Path) -> None:
    living = 1
    names = [".checkpoint.pt.4194305.tmp", ".metrics.jsonl.4194306.tmp", f".policy-best.pt.{living}.tmp", ".notes.tmp"]
    for name in names:
        (tmp_path / name).touch()

    with alone_in(tmp_path):
        assert sorted(path.name for path in tmp_path.iterdir()) == sorted([*names[2:], ".training.lock"])


def test_two_trainings_never_write_one_directory(tmp_path: Path) -> None:
    with alone_in(tmp_path), pytest.raises(DirectoryInUse, match="Another process trains in"):
        run(short_config(), tmp_path)

    assert run(short_config(), tmp_path).finished
