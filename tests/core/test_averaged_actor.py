"""Tests and kept policies act by the running average of the actor; what is learnt does not depend on it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch
from small_training import collected_parts, run, tiny_config
from torch import Tensor

from sldr_core.config import TrainConfig
from sldr_core.nets.locomotion_model import load_locomotion_model
from sldr_core.training import load_policy
from sldr_core.training.build import Parts
from sldr_core.training.cycle import learn

RATE = 0.25
UPDATES = 6


def config_with(rate: float) -> TrainConfig:
    config = tiny_config(updates_per_cycle=UPDATES)
    return replace(config, agent=replace(config.agent, average_rate=rate))


def trained_parts(rate: float, directory: Path) -> Parts:
    directory.mkdir()
    parts = collected_parts(config_with(rate), directory)
    learn(parts, 0, lambda: None)
    return parts


def test_the_average_is_the_weighted_sum_of_all_actors_so_far(tmp_path: Path) -> None:
    parts = collected_parts(config_with(RATE), tmp_path)
    actors: list[list[Tensor]] = []

    def keep() -> None:
        actors.append([weight.detach().clone() for weight in parts.agent.actor.parameters()])

    keep()
    learn(parts, 0, keep)

    shares = [(1 - RATE) ** UPDATES, *(RATE * (1 - RATE) ** age for age in reversed(range(UPDATES)))]
    assert sum(shares) == pytest.approx(1.0)
    for index, averaged in enumerate(parts.agent.averaged_actor.parameters()):
        expected = torch.stack([share * actor[index] for share, actor in zip(shares, actors, strict=True)]).sum(0)
        torch.testing.assert_close(averaged, expected)
        assert not torch.equal(averaged, actors[-1][index])


def test_what_is_learnt_does_not_depend_on_the_average(tmp_path: Path) -> None:
    averaged, plain = trained_parts(RATE, tmp_path / "averaged"), trained_parts(1.0, tmp_path / "plain")

    state, other = averaged.agent.state_dict(), plain.agent.state_dict()

    assert state.keys() - other.keys() == {"averaged_actor"}
    torch.testing.assert_close({name: state[name] for name in other}, other, rtol=0.0, atol=0.0)


def test_without_averaging_the_actor_itself_is_tested(tmp_path: Path) -> None:
    agent = trained_parts(1.0, tmp_path / "plain").agent

    assert agent.averaged_actor is agent.actor


def test_every_kind_of_file_holds_the_average(tmp_path: Path) -> None:
    run(config_with(RATE), tmp_path)

    agent = torch.load(tmp_path / "checkpoint.pt", weights_only=True)["agent"]
    final = load_policy(tmp_path / "checkpoint.pt").actor.state_dict()
    torch.testing.assert_close(final, agent["averaged_actor"], rtol=0.0, atol=0.0)
    assert not torch.equal(final["weights.0"], agent["actor"]["weights.0"])
    newest = load_policy(tmp_path / "policy-newest.pt").actor.state_dict()
    torch.testing.assert_close(newest, final, rtol=0.0, atol=0.0)
    best = load_policy(tmp_path / "policy-best.pt").actor.state_dict()
    model = load_locomotion_model(tmp_path / "locomotion.pt").nets.policy.state_dict()
    torch.testing.assert_close(model, best, rtol=0.0, atol=0.0)


def test_a_checkpoint_of_the_time_before_averages_gives_its_actor(tmp_path: Path) -> None:
    run(config_with(1.0), tmp_path)
    path = tmp_path / "checkpoint.pt"
    content = torch.load(path, weights_only=True)
    del content["config"]["agent"]["average_rate"]
    torch.save(content, path)

    policy = load_policy(path)

    torch.testing.assert_close(policy.actor.state_dict(), content["agent"]["actor"], rtol=0.0, atol=0.0)
    assert policy.config.agent.average_rate == 1.0


def test_episodes_are_explored_around_the_actor_and_not_its_average(tmp_path: Path) -> None:
    parts = trained_parts(RATE, tmp_path / "run")
    obs, goal = torch.randn(5, 12), torch.randn(5, 3)

    explored, tested = parts.agent.act(obs, goal), parts.agent.act_averaged(obs, goal)

    assert not np.allclose(explored, tested)
    torch.testing.assert_close(parts.agent.frozen_policy()(obs, goal), explored)
