"""Every method trains on every task, with a critic for each reward; parts take theirs from locomotion models."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import torch

from sldr_core.config import METHODS, TASKS, TrainConfig, find_task
from sldr_core.envs import make_envs
from sldr_core.errors import BadFile, InvalidConfig, LocomotionMissing
from sldr_core.nets.locomotion_model import LocomotionModel, LocomotionNets, Measured
from sldr_core.nets.views import part_view
from sldr_core.presets import locomotion_tasks, make_config, make_locomotion_config
from sldr_core.training import DirectoryRecorder, load_policy, train

TINY: dict[str, Any] = {
    "loop": {"epochs": 1, "cycles_per_epoch": 1, "episodes_per_cycle": 2, "updates_per_cycle": 2, "batch_size": 8},
    "agent": {"hidden_sizes": [8, 8]},
    "curriculum": {"group_size": 4, "candidates": 5, "kept": 2},
}
PICK = "FetchPickAndPlace"
USUALLY = {
    ("ddpg", "FetchPush"),
    ("her", "FetchPickAndPlace"),
    ("cher", "HandEggRotate"),
    ("cher", "FetchStack2"),
    ("her-dense", "HandPenFull"),
    ("her-dense", "FetchTuple3"),
    ("ddpg-sldr", "FetchStack3"),
    ("her-rnd", "HandBlockRotate"),
    *(("her-sldr", task) for task in ("FetchSlide", "FetchTuple5", "HandBlockFull")),
}
"""Trained in the usual run; the slow one trains all."""

TRAININGS = [
    pytest.param(method, task, marks=() if (method, task) in USUALLY else pytest.mark.slow)
    for method in METHODS
    for task in TASKS
]


def config_of(task: str, method: str = "her-sldr") -> TrainConfig:
    return make_config(task, "manipulation", method, 0, "smoke", TINY)


def untrained_model(task: str, path: Path) -> Path:
    config = make_config(task, "locomotion", "her", 0, "smoke", TINY)
    nets = LocomotionNets(config, torch.Generator().manual_seed(0))
    LocomotionModel(nets, config, Measured(0.0, 4)).save(path / f"{task}.pt")
    return path / f"{task}.pt"


def logged(directory: Path) -> dict[str, float]:
    return json.loads((directory / "metrics.jsonl").read_text().splitlines()[-1])["metrics"]


@pytest.mark.parametrize(("method", "task"), TRAININGS)
def test_every_method_trains_on_every_task_with_a_critic_for_each_reward(
    method: str, task: str, tmp_path: Path
) -> None:
    config = config_of(task, method)
    models = [untrained_model(name, tmp_path) for name in locomotion_tasks(config)]

    result = train(config, DirectoryRecorder(tmp_path / "run"), models[::-1])

    critics = {name for name in logged(tmp_path / "run") if name.startswith("critic/") and name.endswith("/loss")}
    assert result.finished
    assert critics == {f"critic/{stream}/loss" for stream in streams_by_hand(method, task)}


def streams_by_hand(method: str, task: str) -> set[str]:
    """Return the rewards of a method: one for the task, and one for each part or for what is new."""
    streams = {"task"}
    if method.endswith("-sldr"):
        streams |= {f"sldr/{part.name}" for part in find_task(task).parts}
    return streams | {"rnd"} if method == "her-rnd" else streams


@pytest.mark.parametrize("task", ["FetchPickAndPlace", "FetchTuple3", "HandPenTranslate"])
def test_a_locomotion_task_trains_and_leaves_a_model(task: str, tmp_path: Path) -> None:
    config = make_config(task, "locomotion", "her", 0, "smoke", TINY)

    assert train(config, DirectoryRecorder(tmp_path)).finished

    envs = make_envs(task, "locomotion", num_envs=2)
    now = envs.observe()
    assert load_policy(tmp_path / "locomotion.pt").act(now.obs, now.goal).shape == (2, envs.action_size)


def test_locomotion_tasks_are_those_of_the_parts_each_once() -> None:
    assert locomotion_tasks(config_of("FetchStack3")) == (PICK,)
    assert locomotion_tasks(config_of("HandBlockFull")) == ("HandBlockRotate", "HandBlockTranslate")
    assert locomotion_tasks(config_of("FetchStack3", "her")) == ()


def test_the_locomotion_config_keeps_variant_robot_and_compute() -> None:
    config = make_config(
        "FetchStack2",
        "manipulation",
        "her-sldr",
        3,
        "smoke",
        {"scene": {"variant": "original"}, "compute": {"threads": 2}},
    )

    needed = make_locomotion_config(config, "smoke", PICK)

    assert needed == make_locomotion_config(config, "smoke")
    assert (needed.task, needed.phase, needed.seed) == (PICK, "locomotion", 0)
    assert (needed.scene.variant, needed.compute.threads) == ("original", 2)


def test_a_missing_model_is_named(tmp_path: Path) -> None:
    models = [untrained_model("HandEggRotate", tmp_path)]

    with pytest.raises(LocomotionMissing, match="a locomotion model of HandEggTranslate"):
        train(config_of("HandEggFull"), DirectoryRecorder(tmp_path / "run"), models)


def test_a_model_of_another_task_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BadFile, match=f"model of FetchPush; FetchStack2 needs a locomotion model of {PICK}"):
        train(config_of("FetchStack2"), DirectoryRecorder(tmp_path / "run"), [untrained_model("FetchPush", tmp_path)])


def test_two_models_of_one_task_are_refused(tmp_path: Path) -> None:
    model = untrained_model(PICK, tmp_path)

    with pytest.raises(BadFile, match="second locomotion model"):
        train(config_of("FetchStack2"), DirectoryRecorder(tmp_path / "run"), [model, model])


def test_locomotion_of_a_task_whose_objects_learn_elsewhere_is_refused() -> None:
    with pytest.raises(InvalidConfig, match="the objects of FetchStack2 learn in FetchPickAndPlace"):
        make_config("FetchStack2", "locomotion", "her", 0, "smoke")


@pytest.mark.parametrize("task", ["FetchStack3", "FetchTuple5", "HandEggFull"])
def test_a_part_is_given_its_own_state_and_goal_of_what_the_robot_sees(task: str) -> None:
    spec, envs = find_task(task), make_envs(task, num_envs=3)
    for _ in range(3):
        now = envs.step(torch.rand(3, envs.action_size) * 2 - 1)
    obs, goal, achieved = (torch.from_numpy(values) for values in (now.obs, now.goal, now.achieved))

    for part in spec.parts:
        view = part_view(spec, part)
        state, own_goal = view.object_state(obs), view.part_goal(goal)
        if spec.family == "stack":
            entries = slice(3 * part.object_index, 3 * part.object_index + 3)
            assert torch.equal(state[:, :3], achieved[:, entries])
            assert torch.equal(own_goal, goal[:, entries])
        else:
            where = slice(6, 13) if spec.family == "hand" else slice(0, spec.goal_size)
            assert torch.equal(state[:, where], achieved)
            assert torch.equal(own_goal, goal)
        assert state.shape == (3, spec.object_state_size)
