"""The preset `paper` has the paper's numbers, typed here by hand, and those of the authors' code where it is silent."""

from __future__ import annotations

from typing import NamedTuple

import pytest
import torch

from sldr_core.agent import DdpgAgent
from sldr_core.agent.losses import lowest_return
from sldr_core.config import LOCOMOTION_TASKS, TASKS, AgentConfig
from sldr_core.nets.transitions import Transitions
from sldr_core.nets.views import View, joined_features
from sldr_core.presets import make_config


class Robot(NamedTuple):
    """Numbers of a manipulation run."""

    epochs: int
    gamma: float
    lowest: float
    """Lowest target of the task's critic."""
    lowest_auxiliary: float
    """Lowest target of the others."""


class Object(NamedTuple):
    """Numbers of a locomotion run."""

    epochs: int
    gamma: float
    lowest: float


ROBOTS = {
    "FetchPush": Robot(50, 0.98, -50, -50),
    "FetchSlide": Robot(50, 0.98, -50, -50),
    "FetchPickAndPlace": Robot(50, 0.98, -50, -50),
    "FetchStack2": Robot(100, 0.98, -50, -50),
    "FetchStack3": Robot(200, 0.98, -50, -50),
    "FetchTuple3": Robot(100, 0.98, -50, -50),
    "FetchTuple5": Robot(300, 0.98, -50, -50),
    "HandEggRotate": Robot(100, 0.99, -100, -100),
    "HandBlockRotate": Robot(100, 0.99, -100, -100),
    "HandPenRotate": Robot(100, 0.98, -100, -100),
    "HandEggFull": Robot(200, 0.99, -100, -100),
    "HandBlockFull": Robot(200, 0.99, -100, -100),
    "HandPenFull": Robot(200, 0.98, -50, -100),
}

OBJECTS = {
    "FetchPush": Object(20, 0.98, -50),
    "FetchSlide": Object(20, 0.98, -50),
    "FetchPickAndPlace": Object(20, 0.98, -50),
    "FetchTuple3": Object(20, 0.98, -50),
    "FetchTuple5": Object(50, 0.98, -50),
    "HandEggRotate": Object(50, 0.99, -100),
    "HandBlockRotate": Object(50, 0.99, -100),
    "HandPenRotateXYZ": Object(50, 0.99, -100),
    "HandEggTranslate": Object(50, 0.99, -100),
    "HandBlockTranslate": Object(50, 0.99, -100),
    "HandPenTranslate": Object(50, 0.99, -100),
}

TRANSLATION_EPOCHS = 20
"""Of the authors' code, where the paper says 50 for every object in the hand."""

EPISODE_LENGTHS = {"FetchStack3": 100, **{task: 100 for task in ROBOTS | OBJECTS if task.startswith("Hand")}}
"""Control steps of those that have not 50."""

MODELS = {
    "FetchPush": {"FetchPush"},
    "FetchSlide": {"FetchSlide"},
    "FetchPickAndPlace": {"FetchPickAndPlace"},
    "FetchStack2": {"FetchPickAndPlace"},
    "FetchStack3": {"FetchPickAndPlace"},
    "FetchTuple3": {"FetchTuple3"},
    "FetchTuple5": {"FetchTuple5"},
    "HandEggRotate": {"HandEggRotate"},
    "HandBlockRotate": {"HandBlockRotate"},
    "HandPenRotate": {"HandPenRotateXYZ"},
    "HandEggFull": {"HandEggRotate", "HandEggTranslate"},
    "HandBlockFull": {"HandBlockRotate", "HandBlockTranslate"},
    "HandPenFull": {"HandPenRotateXYZ", "HandPenTranslate"},
}
"""Whose locomotion models reward a task's robot."""

KNOWN_ROBOTS = set(TASKS)
KNOWN_OBJECTS = {name for name, spec in (TASKS | LOCOMOTION_TASKS).items() if name in spec.locomotion_tasks}

every_variant = pytest.mark.parametrize("variant", ["ours", "original"])


def lowest_targets(agent: AgentConfig, streams: int) -> list[float]:
    """Return how low the targets of each critic go, as an agent of this config clips them."""
    view = View(2, joined_features)
    names = [str(index) for index in range(streams)]
    learner = DdpgAgent(
        view, 1, names, [1.0] * streams, agent, torch.Generator().manual_seed(0), torch.device("cpu"), autocast=False
    )
    column = torch.zeros(3, 1)
    batch = Transitions(column, column, goal=column, action=column, reward=torch.zeros(3), extra={})
    metrics = learner.update(batch, torch.full((streams, 3), -1e6))
    targets = [
        -(float(metrics[f"critic/{name}/loss"]) ** 0.5) + float(metrics[f"critic/{name}/q_mean"]) for name in names
    ]
    return [round(target, 2) for target in targets]


def test_every_task_is_in_the_tables() -> None:
    assert set(ROBOTS) == set(MODELS) == KNOWN_ROBOTS
    assert set(OBJECTS) == KNOWN_OBJECTS


@every_variant
@pytest.mark.parametrize("task", ROBOTS)
def test_a_robot_s_run_has_the_numbers_of_the_table(task: str, variant: str) -> None:
    config = make_config(task, "manipulation", "her-sldr", 0, "paper", {"scene": {"variant": variant}})

    agent, expected = config.agent, ROBOTS[task]
    assert (config.loop.epochs, agent.gamma) == (expected.epochs, expected.gamma)
    critics = 1 + len(config.task_spec.parts)
    assert lowest_targets(agent, critics) == [expected.lowest] + [expected.lowest_auxiliary] * (critics - 1)
    assert config.task_spec.episode_length == EPISODE_LENGTHS.get(task, 50)
    assert set(config.task_spec.locomotion_tasks) == MODELS[task]


@every_variant
@pytest.mark.parametrize("task", OBJECTS)
def test_an_object_s_run_has_the_numbers_of_the_table(task: str, variant: str) -> None:
    config = make_config(task, "locomotion", "her", 0, "paper", {"scene": {"variant": variant}})

    expected = OBJECTS[task]
    shorter = variant == "original" and task.endswith("Translate")
    assert config.loop.epochs == (TRANSLATION_EPOCHS if shorter else expected.epochs)
    assert config.agent.gamma == expected.gamma
    assert lowest_targets(config.agent, 1) == [expected.lowest]
    assert (config.exploration.random_action_probability, config.exploration.noise_std) == (0.2, 0.05)


@pytest.mark.parametrize("phase", ["locomotion", "manipulation"])
def test_every_run_has_the_loop_and_the_nets_of_the_paper(phase: str) -> None:
    config = make_config("FetchPush", phase, "her", 0, "paper")  # pyright: ignore[reportArgumentType]

    loop, agent = config.loop, config.agent
    assert (loop.cycles_per_epoch, loop.episodes_per_cycle, loop.test_episodes) == (50, 38, 380)
    assert (loop.updates_per_cycle, loop.updates_per_sync, loop.batch_size) == (40, 40, 4864)
    assert (agent.hidden_sizes, agent.learning_rate, agent.target_rate) == ((256, 256, 256), 1e-3, 0.05)
    assert (agent.action_l2, config.replay.capacity, config.replay.relabel_probability) == (1.0, 1_000_000, 0.8)
    if phase == "manipulation":
        assert (config.exploration.random_action_probability, config.exploration.noise_std) == (0.3, 0.2)


@pytest.mark.parametrize("task", TASKS)
def test_the_quick_preset_clips_to_what_its_own_discount_allows(task: str) -> None:
    agent = make_config(task, "manipulation", "her-sldr", 0, "quick").agent

    assert lowest_targets(agent, 2) == [pytest.approx(lowest_return(agent.gamma))] * 2
