"""A rollout follows its policy file, counts successes, and says what it shows."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from sldr_core.errors import BadFile
from worker.viewer.panel import describe
from worker.viewer.policy_file import PolicyFile
from worker.viewer.rollout import Rollout, make_rollout_envs


@pytest.fixture
def rollout(policy_path: Path) -> Rollout:
    policy_file = PolicyFile(policy_path)
    return Rollout(make_rollout_envs(policy_file.policy, seed=1), policy_file)


def test_an_episode_is_over_after_its_steps_and_counted_once(rollout):
    while not rollout.is_over:
        rollout.advance()
    assert rollout.step == rollout.envs.episode_length
    assert rollout.finished == 1
    assert rollout.successes == int(rollout.is_reached)


def test_a_restart_draws_a_new_goal(rollout):
    goal = rollout.goal.copy()
    rollout.restart()
    assert rollout.episode == 2
    assert (rollout.goal != goal).any()


def test_a_locomotion_policy_runs_without_a_robot(rollout):
    names = {rollout.envs.model.body(body).name for body in range(rollout.envs.model.nbody)}
    assert not any(name.startswith("robot0:") for name in names)


def test_the_panel_names_task_epoch_and_episode(rollout):
    text = describe(rollout)
    assert "FetchPush" in text
    assert "epoch 1, test success 25%" in text
    assert "Episode 1," in text


def test_a_changed_file_is_loaded_at_the_next_episode(tmp_path, write_policy_file):
    path = tmp_path / "policy-newest.pt"
    write_policy_file(path, cycle=2)
    policy_file = PolicyFile(path)
    rollout = Rollout(make_rollout_envs(policy_file.policy, seed=1), policy_file)
    write_policy_file(tmp_path / "next.pt", cycle=8)
    os.replace(tmp_path / "next.pt", path)
    assert policy_file.policy.epoch == 1
    rollout.restart()
    assert policy_file.policy.epoch == 4


def test_a_corrupt_newer_file_is_named_and_the_old_policy_stays(tmp_path, write_policy_file):
    path = tmp_path / "policy-newest.pt"
    write_policy_file(path)
    policy_file = PolicyFile(path)
    path.write_bytes(b"not a policy")
    assert not policy_file.refresh()
    assert policy_file.policy.epoch == 1
    assert policy_file.problem is not None
    assert str(path) in policy_file.problem


def test_a_corrupt_first_file_is_refused(tmp_path):
    (tmp_path / "policy-newest.pt").write_bytes(b"not a policy")
    with pytest.raises(BadFile):
        PolicyFile(tmp_path / "policy-newest.pt")
