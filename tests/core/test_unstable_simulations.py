"""A simulation whose physics comes apart is set back by MuJoCo: such an episode fails, and nothing learns from it."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
import pytest
from small_training import metrics_of, run, tiny_config

from sldr_core.envs import Envs, Observation, make_envs
from sldr_core.errors import TrainingDiverged
from sldr_core.training.rollout import Collected, collect_episodes

HUGE = 1e12
"""A joint's velocity [rad/s or m/s] that no simulation survives."""

ALL_MEET = np.ones(4, dtype=np.bool_)


@pytest.fixture(autouse=True)
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let MuJoCo write its log where it is thrown away."""
    monkeypatch.chdir(tmp_path)


def four_push() -> Envs:
    return make_envs("FetchPush", "manipulation", num_envs=4, seed=0, threads=1)


def collect_with_broken(envs: Envs, broken: list[int], at: int = 10) -> Collected:
    """Run an episode of the resting robot; the physics of some simulations come apart in step `at`."""
    steps = iter(range(envs.episode_length))

    def act(obs: np.ndarray, goal: np.ndarray) -> np.ndarray:
        if next(steps) == at:
            envs.qvel[broken] = HUGE
        return np.zeros((len(obs), envs.action_size), dtype=np.float32)

    return collect_episodes(envs, act, lambda: None)


def test_it_is_told_until_the_next_episode() -> None:
    envs = four_push()
    assert not envs.unstable().any()
    envs.qvel[2] = HUGE
    for _ in range(3):
        envs.step(np.zeros((4, envs.action_size)))
        assert envs.unstable().tolist() == [False, False, True, False]
    envs.reset()
    assert not envs.unstable().any()


def test_its_episode_fails_though_the_goal_is_met(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(Envs, "success", lambda *_: ALL_MEET)
    with caplog.at_level(logging.WARNING):
        collected = collect_with_broken(four_push(), [0, 2])
    assert collected.unstable.tolist() == [True, False, True, False]
    assert collected.success.tolist() == [False, True, False, True]
    assert "found simulations unstable (0, 2)" in caplog.text


def test_stable_episodes_stand_in_for_it() -> None:
    collected = collect_with_broken(four_push(), [0, 2, 3])
    usable = collected.usable_episodes()
    for name in ("obs", "achieved", "goal", "action"):
        rows = getattr(collected.episodes, name)
        np.testing.assert_array_equal(getattr(usable, name), rows[[1, 1, 1, 1]])


def test_stable_episodes_are_used_as_they_are() -> None:
    collected = collect_with_broken(four_push(), [])
    assert collected.usable_episodes() is collected.episodes


def test_a_training_goes_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    healthy, steps = Envs.step, iter(range(10**6))

    def step(envs: Envs, action: np.ndarray) -> Observation:
        if next(steps) == 5:
            envs.qvel[1] = HUGE
        return healthy(envs, action)

    monkeypatch.setattr(Envs, "step", step)
    assert run(tiny_config(), tmp_path / "run").finished
    assert len(metrics_of(tmp_path / "run")) == 4


def test_a_training_without_any_stable_simulation_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    healthy = Envs.step

    def step(envs: Envs, action: np.ndarray) -> Observation:
        envs.qvel[:] = HUGE
        return healthy(envs, action)

    monkeypatch.setattr(Envs, "step", step)
    with pytest.raises(TrainingDiverged, match="All 2 simulations became unstable in one episode"):
        run(tiny_config(), tmp_path / "run")
