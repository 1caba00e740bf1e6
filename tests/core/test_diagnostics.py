"""What a researcher looks at when a training goes wrong says what it says it does."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import torch
from small_training import metrics_of, run, save_untrained_model, tiny_config

from sldr_core.agent import InverseLearner
from sldr_core.config import AgentConfig, Phase
from sldr_core.nets.normalizer import STD_FLOOR, Normalizer
from sldr_core.nets.transitions import Transitions
from sldr_core.streams import SldrStream, TaskStream
from sldr_core.training.build import build_training
from sldr_core.training.cycle import collect, collect_random, learn
from sldr_core.training.gathering import Gathered

PAGE = Path(__file__).parents[2] / "docs" / "training.md"
STREAM_PARTS = ("mean", "clip_low_share", "clip_high_share")
CRITIC_PARTS = ("loss", "q_mean", "q_min", "q_max", "target_clip_low_share", "target_clip_high_share")


def nothing() -> None:
    """Check nothing between steps."""


def test_every_cycle_tells_of_every_stream(tmp_path: Path) -> None:
    model = save_untrained_model(tmp_path / "model.pt")
    run(tiny_config("manipulation", "her-sldr"), tmp_path / "run", (model,))

    for line in metrics_of(tmp_path / "run"):
        logged = set(line["metrics"])
        for stream in ("task", "sldr/object0"):
            assert {f"stream/{stream}/{part}" for part in STREAM_PARTS} <= logged
            assert {f"critic/{stream}/{part}" for part in CRITIC_PARTS} <= logged
        assert {"actor/saturated_share", "normalizer/shift_drift", "normalizer/scale_drift"} <= logged
        assert not {name for name in logged if name.startswith("inverse/")}


def test_every_cycle_of_an_object_tells_of_its_inverse_model(tmp_path: Path) -> None:
    run(tiny_config(), tmp_path)

    for line in metrics_of(tmp_path):
        assert {"inverse/loss", "inverse/fresh_error"} <= set(line["metrics"])


@pytest.mark.parametrize(
    ("phase", "method"), [("locomotion", "her"), ("manipulation", "her-sldr"), ("manipulation", "her-rnd")]
)
def test_the_page_on_trainings_explains_every_number(phase: Phase, method: str, tmp_path: Path) -> None:
    page = PAGE.read_text()
    run(tiny_config(phase, method), tmp_path / "run", (save_untrained_model(tmp_path / "model.pt"),))

    names = {name for line in metrics_of(tmp_path / "run") for name in line["metrics"]}

    for name in names - {"progress/fraction"}:
        group, *stream, part = name.split("/")
        place = f"`{group}/<stream>/" if stream else f"`{group}/"
        assert any(place in line and f"{part}`" in line for line in page.splitlines()), name


def test_means_least_and_greatest_values_are_gathered_over_a_cycle() -> None:
    gathered = Gathered()
    for q in (3.0, -2.0, 5.0):
        value = torch.tensor(q)
        gathered.add({"critic/task/q_mean": value, "critic/task/q_min": value - 1, "critic/task/q_max": value + 1})

    assert gathered.close() == {"critic/task/q_mean": 2.0, "critic/task/q_min": -3.0, "critic/task/q_max": 6.0}


def test_rewards_at_their_limits_are_counted_apart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    model = save_untrained_model(tmp_path / "model.pt")
    parts = build_training(tiny_config("manipulation", "her-sldr"), tmp_path, (model,))
    collect_random(parts, nothing)

    def eighths(_: object, batch: Transitions) -> torch.Tensor:
        # Of 16: two at the lower limit, four at the upper, the others between.
        return torch.tensor([-1.0] * 2 + [0.0] * 4 + [-0.5] * 10)

    monkeypatch.setattr(SldrStream, "reward", eighths)
    monkeypatch.setattr(TaskStream, "reward", lambda _, batch: torch.full((16,), -1.0))

    metrics = learn(parts, 0, nothing)

    assert metrics["stream/sldr/object0/clip_low_share"] == 0.125
    assert metrics["stream/sldr/object0/clip_high_share"] == 0.25
    assert metrics["stream/sldr/object0/mean"] == pytest.approx(-7.0 / 16.0)
    assert [metrics[f"stream/task/{part}"] for part in STREAM_PARTS] == [-1.0, 1.0, 0.0]


def test_drift_is_told_in_deviations_of_the_entry_that_moved_most() -> None:
    normalizer = Normalizer(2)
    normalizer.update(torch.tensor([[-1.0, 10.0], [1.0, 30.0]]))  # mean 0 and 20, deviation 1 and 10

    drift = normalizer.update(torch.tensor([[-1.0, 20.0], [1.0, 60.0]]))  # then 0 and 30, 1 and sqrt(350)

    deviation = 350.0**0.5 + STD_FLOOR
    assert drift.shift.item() == pytest.approx(10.0 / deviation, rel=1e-5)
    assert drift.scale.item() == pytest.approx(1.0 - (10.0 + STD_FLOOR) / deviation, rel=1e-5)


def test_a_normaliser_that_is_shown_the_same_again_hardly_drifts() -> None:
    data, normalizer = torch.randn(1000, 3, generator=torch.Generator().manual_seed(0)), Normalizer(3)
    normalizer.update(data)

    drift = normalizer.update(data)

    assert max(drift.shift.item(), drift.scale.item()) < 1e-6


def test_the_fresh_error_is_a_root_mean_square_in_action_units() -> None:
    learner = InverseLearner(
        4, 2, AgentConfig(hidden_sizes=(8,)), torch.Generator().manual_seed(0), torch.device("cpu"), autocast=False
    )
    for parameter in learner.net.parameters():
        parameter.data.zero_()
    action = torch.tensor([[[0.6, -0.8], [0.0, 0.0]]])  # squares 0.36, 0.64, 0, 0: their mean is 0.25

    assert learner.error(torch.zeros(1, 2, 4), torch.zeros(1, 2, 4), action).item() == pytest.approx(0.5)


def test_the_fresh_error_is_of_episodes_that_the_model_has_not_seen(tmp_path: Path) -> None:
    parts = build_training(tiny_config(), tmp_path, [])
    collect_random(parts, nothing)
    assert parts.inverse is not None
    normalizer = parts.inverse.normalizer.state_dict()
    before = {name: value.clone() for name, value in normalizer.items()}

    collected, metrics = collect(parts, nothing)

    parts.inverse.normalizer.load_state_dict(before)
    episodes = collected.episodes
    obs = torch.from_numpy(episodes.obs)
    expected = parts.inverse.error(obs[:, :-1], obs[:, 1:], torch.from_numpy(episodes.action)).item()
    assert metrics["inverse/fresh_error"] == expected
    assert np.isfinite(expected)
