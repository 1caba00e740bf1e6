"""Collecting episodes while the learner works gives what the two give one after the other."""

from __future__ import annotations

import os
import threading
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest
import torch
from small_training import (
    StoppingRecorder,
    assert_same_training,
    run,
    save_untrained_model,
    tiny_config,
)

from sldr_core.config import ComputeConfig, TrainConfig
from sldr_core.errors import InvalidConfig
from sldr_core.presets import make_config
from sldr_core.processor import THREADS_VARIABLE
from sldr_core.training import train
from sldr_core.training.build import Parts, build_training
from sldr_core.training.compute import resolve_compute
from sldr_core.training.cycle import collect_random, cycle_beside, learn, store
from sldr_core.training.rollout import collect_episodes, numpy_policy

UPDATES = 3
"""Of a cycle."""


def nothing() -> None:
    """Check nothing between steps."""


def beside_config(**loop: Any) -> TrainConfig:
    return tiny_config("manipulation", "her-sldr", collecting="beside", updates_per_cycle=UPDATES, **loop)


def build(directory: Path, model: Path) -> Parts:
    directory.mkdir()
    parts = build_training(beside_config(), directory, [model])
    collect_random(parts, nothing)
    return parts


def count_threads() -> int:
    """Return how many threads this process has, those of libraries too."""
    return len(os.listdir("/proc/self/task"))


def assert_equal(ours: Any, theirs: Any) -> None:
    """Compare nested states to the last bit."""
    if isinstance(ours, dict):
        assert ours.keys() == theirs.keys()
        for name, value in ours.items():
            assert_equal(value, theirs[name])
    elif isinstance(ours, torch.Tensor):
        assert torch.equal(ours, theirs)
    else:
        assert ours == theirs


@pytest.fixture
def model(tmp_path: Path) -> Path:
    return save_untrained_model(tmp_path / "model.pt")


def test_a_cycle_gives_what_its_halves_give_one_after_the_other(tmp_path: Path, model: Path) -> None:
    beside, plain = build(tmp_path / "beside", model), build(tmp_path / "plain", model)

    for cycle in range(3):
        cycle_beside(beside, cycle * UPDATES, nothing)

        acting = deepcopy(plain.agent)
        learn(plain, cycle * UPDATES, nothing)
        collected = collect_episodes(plain.envs, plain.exploration.around(numpy_policy(acting.act)), nothing)
        store(plain, collected)

    assert beside.buffer.arrays["obs"][:8].any(axis=(1, 2)).all()
    assert_equal(beside.learner_states(), plain.learner_states())
    for name, array in beside.buffer.arrays.items():
        assert (array == plain.buffer.arrays[name]).all(), name


def test_acting_beside_the_learner_starts_no_threads_of_its_own(
    tmp_path: Path, model: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    parts, started = build(tmp_path / "run", model), []
    left, right = torch.ones(512, 512), torch.ones(512, 512)

    def act(obs: torch.Tensor, goal: torch.Tensor) -> torch.Tensor:
        before = count_threads()
        torch.mm(left, right)
        started.append(count_threads() - before)
        return torch.zeros(len(obs), parts.envs.action_size)

    monkeypatch.setattr(parts.agent, "frozen_policy", lambda: act)
    monkeypatch.setattr(parts.agent, "update", lambda *_: {})
    before = torch.get_num_threads()
    torch.set_num_threads(2)
    torch.mm(left, right)  # The learner's own thread would else come at its first product, which may be just then.
    try:
        cycle_beside(parts, 0, nothing)
        assert torch.get_num_threads() == 2
    finally:
        torch.set_num_threads(before)

    # Fewer there may be: those of simulations that an earlier test has left end whenever they do.
    assert len(started) == parts.envs.episode_length
    assert max(started) <= 0


def test_a_training_that_was_stopped_goes_on_to_the_same_bits(tmp_path: Path, model: Path) -> None:
    config = beside_config(epochs=3)
    run(config, tmp_path / "whole", (model,))

    train(config, StoppingRecorder(tmp_path / "halves", 3, "pause"), (model,))
    run(config, tmp_path / "halves", (model,))

    assert_same_training(tmp_path / "whole", tmp_path / "halves")


def test_collecting_ends_where_learning_fails(tmp_path: Path, model: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    parts = build(tmp_path / "run", model)
    begun, steps = threading.Event(), []
    step = parts.envs.step

    def slow_step(action: Any) -> Any:
        steps.append(1)
        begun.set()
        failed.wait(10.0)
        return step(action)

    failed = threading.Event()

    def failing_update(*_: Any) -> Any:
        begun.wait(10.0)
        threading.Timer(0.05, failed.set).start()
        raise ZeroDivisionError("the learner")

    monkeypatch.setattr(parts.envs, "step", slow_step)
    monkeypatch.setattr(parts.agent, "update", failing_update)

    with pytest.raises(ZeroDivisionError, match="the learner"):
        cycle_beside(parts, 0, nothing)

    assert len(steps) == 1
    assert not [thread for thread in threading.enumerate() if thread.name.startswith("collecting")]


def test_there_must_be_something_to_learn_from_at_first() -> None:
    with pytest.raises(InvalidConfig, match="warmup_cycles"):
        make_config(
            "FetchPush", "manipulation", "her", 0, "smoke", {"loop": {"collecting": "beside", "warmup_cycles": 0}}
        )


@pytest.mark.parametrize(("threads", "learning", "collecting"), [(1, 1, 1), (2, 1, 2), (3, 1, 3), (4, 2, 2), (5, 2, 3)])
def test_the_two_share_the_threads(threads: int, learning: int, collecting: int) -> None:
    before = torch.get_num_threads()
    try:
        compute = resolve_compute(
            make_config(
                "FetchPush", "manipulation", "her", 0, "smoke", {"compute": {"threads": threads, "device": "cpu"}}
            ).compute,
            beside=True,
        )
        used = torch.get_num_threads()
    finally:
        torch.set_num_threads(before)

    assert (compute.threads, compute.collecting_threads) == (threads, collecting)
    assert used == learning


def test_a_training_that_names_no_number_takes_the_threads_that_its_process_is_granted(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv(THREADS_VARIABLE, "3")
    before = torch.get_num_threads()
    try:
        compute = resolve_compute(ComputeConfig(device="cpu"))
        used = torch.get_num_threads()
    finally:
        torch.set_num_threads(before)

    assert compute.threads == used == 3
