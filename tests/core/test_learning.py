"""The whole library at once: an object learns to move itself to its goal."""

from __future__ import annotations

from pathlib import Path

import pytest
from small_training import run

from sldr_core.nets.locomotion_model import load_locomotion_model
from sldr_core.presets import make_config
from sldr_core.training import evaluate

LEARNT = 0.95
"""Test success that counts as learnt: the gate of the manipulation runs."""


@pytest.mark.learning
@pytest.mark.timeout(900)
def test_an_object_learns_to_move_itself_to_its_goal(tmp_path: Path) -> None:
    # One thread: on a busy machine threads that wait for each other take many times as long. The preset asks for two
    # good tests in a row; here the model's second test is `evaluate`, with other goals.
    changes = {"compute": {"threads": 1}, "loop": {"cycles_per_epoch": 7, "stop_after_tests": 1}}
    config = make_config("FetchPush", "locomotion", "her", 0, "quick", changes)

    result = run(config, tmp_path)

    assert result.best_success_rate is not None
    assert result.best_success_rate >= LEARNT
    assert load_locomotion_model(tmp_path / "locomotion.pt").measured.success_rate == result.best_success_rate
    fresh = evaluate(tmp_path / "locomotion.pt", episodes=200, seed=12345)
    assert fresh.success_rate >= LEARNT
