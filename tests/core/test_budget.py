"""What a training will take is told from its config alone, and is what it then takes."""

from __future__ import annotations

from pathlib import Path

import pytest
from small_training import TINY, metrics_of, run, save_untrained_model, tiny_config

from sldr_core.config import Phase
from sldr_core.presets import locomotion_tasks, make_config
from sldr_core.presets.budget import control_steps, gradient_updates, replay_file_size
from sldr_core.training.build import build_training


@pytest.mark.parametrize(
    ("task", "phase", "method"),
    [
        ("FetchPush", "locomotion", "her"),
        ("FetchPush", "manipulation", "her-rnd"),
        ("FetchStack2", "manipulation", "her-sldr"),
        ("FetchTuple3", "manipulation", "her-sldr"),
        ("HandEggRotate", "locomotion", "her"),
    ],
)
def test_the_replay_file_has_the_size_that_was_foretold(task: str, phase: Phase, method: str, tmp_path: Path) -> None:
    config = make_config(task, phase, method, 0, "smoke", TINY | {"replay": {"capacity": 1000}})
    models = [save_untrained_model(tmp_path / f"{needed}.pt", needed) for needed in locomotion_tasks(config)]

    parts = build_training(config, tmp_path, models)

    assert replay_file_size(config) == parts.buffer.file_size == (tmp_path / "replay.bin").stat().st_size


def test_a_training_takes_the_steps_and_updates_that_were_foretold(tmp_path: Path) -> None:
    config = tiny_config(epochs=2, cycles_per_epoch=3)
    run(config, tmp_path)

    last = metrics_of(tmp_path)[-1]
    # two tests of three episodes, two at a time, eight steps each
    tests = 2 * 2 * 2 * 8
    assert control_steps(config) == last["env_steps"] + tests
    assert gradient_updates(config) == last["updates"] == 2 * 3 * 2
