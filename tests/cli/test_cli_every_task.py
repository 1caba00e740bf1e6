"""`sldr train` and `sldr evaluate` for every task, phase and file."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from sldr_core.config import LOCOMOTION_TASKS, TASKS, find_task
from worker.cli import main

OF_EACH_KIND = {"FetchStack2", "HandPenFull"}
"""Trained in the usual run, with the objects that they need; the slow one trains all."""

SMALL = (
    "loop.epochs=1",
    "loop.cycles_per_epoch=1",
    "loop.episodes_per_cycle=2",
    "loop.test_episodes=2",
    "loop.batch_size=16",
)
EPISODES = 3
PRINTED = re.compile(r"\d+\.\d% success: \d of 3 episodes, 95 % interval \d+\.\d% to \d+\.\d%\n")


def sldr(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    """Run a command in this process and return what it printed."""
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    printed = capsys.readouterr()
    assert ended.value.code == 0, printed.err
    return printed.out


def train(capsys: pytest.CaptureFixture[str], task: str, phase: str, out: Path, *models: Path) -> None:
    settings = [word for setting in SMALL for word in ("--set", setting)]
    given = [word for model in models for word in ("--locomotion-model", str(model))]
    command = ("train", "--task", task, "--phase", phase, "--preset", "smoke", "--out", str(out), *settings, *given)
    assert sldr(capsys, *command).startswith("Finished: ")


def files_of(directory: Path) -> Iterator[Path]:
    """Return every file of a run that holds a policy."""
    files = sorted(directory.glob("*.pt"))
    assert {path.name for path in files} >= {"checkpoint.pt", "policy-best.pt", "policy-newest.pt"}
    yield from files


@pytest.mark.parametrize(
    "task", [pytest.param(task, marks=() if task in OF_EACH_KIND else pytest.mark.slow) for task in TASKS]
)
def test_a_task_is_trained_and_every_file_measured(
    task: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    objects = find_task(task).locomotion_tasks
    for name in objects:
        train(capsys, name, "locomotion", tmp_path / f"{name}-object")
    models = [tmp_path / f"{name}-object" / "locomotion.pt" for name in objects]
    train(capsys, task, "manipulation", tmp_path / "robot", *models)

    for path in (*files_of(tmp_path / "robot"), *models):
        printed = sldr(capsys, "evaluate", str(path), "--episodes", str(EPISODES))
        assert PRINTED.fullmatch(printed), f"{path}: {printed}"


@pytest.mark.slow
@pytest.mark.parametrize("task", LOCOMOTION_TASKS)
def test_an_object_that_exists_alone_is_trained_and_every_file_measured(
    task: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    train(capsys, task, "locomotion", tmp_path)

    assert (tmp_path / "locomotion.pt").exists()
    for path in files_of(tmp_path):
        assert PRINTED.fullmatch(sldr(capsys, "evaluate", str(path), "--episodes", str(EPISODES)))
