"""Equal configs train equally; what is logged, tested and saved is what happened."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import torch
from small_training import assert_same_training, metrics_of, run, save_untrained_model, state_of, tiny_config

from sldr_core.config import PHASES, Phase
from sldr_core.nets.locomotion_model import load_locomotion_model
from sldr_core.presets import make_config
from sldr_core.training import load_policy, testing
from sldr_core.training.build import Parts, build_training
from sldr_core.training.cycle import collect_random, learn

METHOD: dict[Phase, str] = {"locomotion": "her", "manipulation": "her-sldr"}


def nothing() -> None:
    """Check nothing between steps."""


@pytest.fixture
def model(tmp_path: Path) -> Path:
    return save_untrained_model(tmp_path / "model.pt")


@pytest.mark.parametrize("phase", PHASES)
def test_the_smoke_preset_trains_from_end_to_end(phase: Phase, tmp_path: Path) -> None:
    config = make_config("FetchPush", phase, METHOD[phase], 0, "smoke")
    model = save_untrained_model(tmp_path / "model.pt", task="FetchPush")

    result = run(config, tmp_path / "run", (model,))

    loop, lines = config.loop, metrics_of(tmp_path / "run")
    assert result.finished
    assert result.stopped is None
    assert [line["cycle"] for line in lines] == [1, 2, 3, 4]
    assert [line["epoch"] for line in lines] == [1, 1, 2, 2]
    assert lines[-1]["updates"] == 4 * loop.updates_per_cycle
    assert lines[-1]["episodes"] == (4 + loop.warmup_cycles) * loop.episodes_per_cycle
    assert lines[-1]["env_steps"] == 50 * lines[-1]["episodes"]
    assert ["test/success_rate" in line["metrics"] for line in lines] == [False, True, False, True]
    assert [line["metrics"]["progress/fraction"] for line in lines] == [0.4, 0.6, 0.8, 1.0]


@pytest.mark.parametrize("phase", PHASES)
def test_the_same_config_gives_the_same_bits(phase: Phase, tmp_path: Path, model: Path) -> None:
    config = tiny_config(phase, METHOD[phase])

    for name in ("first", "again"):
        run(config, tmp_path / name, (model,))

    assert_same_training(tmp_path / "first", tmp_path / "again")


def test_the_number_of_threads_that_simulate_does_not_change_the_episodes(tmp_path: Path) -> None:
    stored = []
    for threads in (1, 2):
        config = tiny_config()
        config = replace(config, compute=replace(config.compute, threads=threads))
        (tmp_path / str(threads)).mkdir()
        parts = build_training(config, tmp_path / str(threads), [])
        collect_random(parts, nothing)
        stored.append(parts.buffer.arrays["obs"].copy())

    assert (stored[0] == stored[1]).all()


def test_another_seed_gives_other_numbers(tmp_path: Path) -> None:
    for seed in (0, 1):
        run(tiny_config(seed=seed), tmp_path / str(seed))

    ours, theirs = (metrics_of(tmp_path / str(seed))[-1]["metrics"] for seed in (0, 1))
    for name in ("critic/task/loss", "actor/loss", "inverse/loss", "test/final_distance"):
        assert ours[name] != theirs[name]
    assert state_of(tmp_path / "0")["agent"]["actor"] != state_of(tmp_path / "1")["agent"]["actor"]


@pytest.fixture
def parts(tmp_path: Path) -> Parts:
    parts = build_training(tiny_config(updates_per_cycle=5, updates_per_sync=3), tmp_path, [])
    collect_random(parts, nothing)
    return parts


def test_targets_are_synced_in_their_rhythm_across_cycles(parts: Parts, monkeypatch: pytest.MonkeyPatch) -> None:
    events: list[str] = []
    update = parts.agent.update

    def counted_update(*arguments: Any) -> Any:
        events.append("u")
        return update(*arguments)

    monkeypatch.setattr(parts.agent, "update", counted_update)
    monkeypatch.setattr(parts.agent, "sync_targets", lambda: events.append("S"))

    for cycle in range(3):
        learn(parts, 5 * cycle, nothing)

    assert "".join(events) == "uuuSuuuSuuuSuuuSuuuS"


def test_logged_numbers_are_means_over_the_updates_of_a_cycle(parts: Parts, monkeypatch: pytest.MonkeyPatch) -> None:
    values = iter([1.0, 2.0, 3.0, 4.0, 10.0])
    monkeypatch.setattr(parts.agent, "update", lambda *_: {"actor/loss": torch.tensor(next(values))})

    assert learn(parts, 0, nothing)["actor/loss"] == pytest.approx(4.0)


def test_training_ends_early_once_enough_tests_in_a_row_succeed(tmp_path: Path) -> None:
    config = tiny_config(epochs=50, cycles_per_epoch=1, stop_at_success=0.0, stop_after_tests=3)

    result = run(config, tmp_path)

    assert result.finished
    assert [line["cycle"] for line in metrics_of(tmp_path)] == [1, 2, 3]
    assert metrics_of(tmp_path)[-1]["metrics"]["progress/fraction"] == 1.0
    assert run(config, tmp_path) == result, "a finished run has nothing left to do"
    assert len(metrics_of(tmp_path)) == 3


def test_training_goes_on_while_tests_fail(tmp_path: Path) -> None:
    run(tiny_config(epochs=4, cycles_per_epoch=1, stop_at_success=1.0, stop_after_tests=1), tmp_path)

    assert len(metrics_of(tmp_path)) == 4


def test_the_locomotion_model_is_that_of_the_best_test(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rates = iter([1, 3, 2, 0])
    monkeypatch.setattr("sldr_core.training.loop.run_test", lambda *_: testing.TestResult(next(rates), 4, 0.1))

    result = run(tiny_config(epochs=4, cycles_per_epoch=1), tmp_path)

    model, best = load_locomotion_model(tmp_path / "locomotion.pt"), load_policy(tmp_path / "policy-best.pt")
    newest = load_policy(tmp_path / "policy-newest.pt")
    logged = [line["metrics"]["test/best_success_rate"] for line in metrics_of(tmp_path)]
    assert (result.best_success_rate, result.test_success_rate) == (0.75, 0.0)
    assert (model.measured.success_rate, model.measured.episodes) == (0.75, 4)
    assert (best.epoch, best.success_rate, newest.epoch, newest.success_rate) == (2, 0.75, 4, 0.0)
    assert logged == [0.25, 0.75, 0.75, 0.75]
    state = torch.randn(5, 12, generator=torch.Generator().manual_seed(0))
    goal = torch.zeros(5, 3)
    wanted = model.nets.action(model.nets.features(state, goal)).numpy()
    assert (wanted == best.act(state.numpy(), goal.numpy())).all()
    assert (wanted != newest.act(state.numpy(), goal.numpy())).any()
