"""Trainings on the hand's tasks go from end to end; the full tasks take two locomotion models."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from sldr_core.config import TASKS, TrainConfig, find_task
from sldr_core.errors import BadFile, LocomotionMissing
from sldr_core.presets import make_config, make_locomotion_config
from sldr_core.training import DirectoryRecorder, train

TINY = {
    "loop": {"epochs": 1, "cycles_per_epoch": 1, "episodes_per_cycle": 2, "test_episodes": 2, "batch_size": 16},
    "agent": {"hidden_sizes": [8, 8]},
    "replay": {"capacity": 400},
}
"""Laid over the smoke preset: one cycle of two episodes."""

HAND_TASKS = [name for name in TASKS if name.startswith("Hand")]
SHORT_TASKS = ["HandPenFull"]


def run(config: TrainConfig, directory: Path, models: tuple[Path, ...] = ()) -> dict[str, Any]:
    """Train and return the last metrics."""
    assert train(config, DirectoryRecorder(directory), models).finished
    return json.loads((directory / "metrics.jsonl").read_text().splitlines()[-1])["metrics"]


def manipulation(task: str, method: str) -> TrainConfig:
    return make_config(task, "manipulation", method, 0, "smoke", TINY)


def locomotion_model(task: str, directory: Path) -> Path:
    config = make_config(task, "locomotion", "her", 0, "smoke", TINY)
    run(config, directory)
    return directory / "locomotion.pt"


def streams_of(metrics: dict[str, Any]) -> set[str]:
    prefix, suffix = "critic/", "/loss"
    return {name[len(prefix) : -len(suffix)] for name in metrics if name.startswith(prefix) and name.endswith(suffix)}


def assert_trains_with_every_part(task: str, directory: Path) -> None:
    learnt_in = find_task(task).locomotion_tasks
    models = tuple(locomotion_model(name, directory / name) for name in learnt_in)

    plain = run(manipulation(task, "her"), directory / "her")
    helped = run(manipulation(task, "her-sldr"), directory / "her-sldr", models)

    assert streams_of(plain) == {"task"}
    assert streams_of(helped) == {"task", *(f"sldr/{part.name}" for part in find_task(task).parts)}


@pytest.mark.parametrize("task", SHORT_TASKS)
def test_a_hand_learns_with_a_critic_for_the_task_and_one_for_each_part(task: str, tmp_path: Path) -> None:
    assert_trains_with_every_part(task, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("task", [task for task in HAND_TASKS if task not in SHORT_TASKS])
def test_every_other_hand_learns_with_a_critic_for_the_task_and_one_for_each_part(task: str, tmp_path: Path) -> None:
    assert_trains_with_every_part(task, tmp_path)


def test_a_full_task_names_the_locomotion_model_that_is_missing(tmp_path: Path) -> None:
    rotation = locomotion_model("HandEggRotate", tmp_path / "rotation")

    with pytest.raises(LocomotionMissing, match="HandEggTranslate"):
        train(manipulation("HandEggFull", "her-sldr"), DirectoryRecorder(tmp_path / "full"), (rotation,))


def test_a_full_task_refuses_the_model_of_another_object(tmp_path: Path) -> None:
    block = locomotion_model("HandBlockRotate", tmp_path / "block")

    with pytest.raises(BadFile, match="HandBlockRotate"):
        train(manipulation("HandEggFull", "her-sldr"), DirectoryRecorder(tmp_path / "full"), (block,))


@pytest.mark.parametrize("task", HAND_TASKS)
def test_the_locomotion_runs_of_a_hand_keep_the_robot_in_the_scene(task: str) -> None:
    config = make_config(task, "manipulation", "her-sldr", 0, "smoke")

    runs = [make_locomotion_config(config, "smoke", name) for name in config.task_spec.locomotion_tasks]

    assert {run.scene.locomotion_robot for run in runs} <= {"auto", "still"}
    assert [run.task for run in runs] == [part.locomotion_task for part in config.task_spec.parts]
