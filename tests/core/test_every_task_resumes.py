"""For every task, a training that was put together anew after each cycle ends with the bits of a whole one."""

from __future__ import annotations

from pathlib import Path

import pytest
from small_training import StoppingRecorder, assert_same_training, run, save_untrained_model

from sldr_core.config import LOCOMOTION_METHOD, LOCOMOTION_TASKS, TASKS, Phase
from sldr_core.episodes import episodes_file, read_episodes
from sldr_core.presets import Settings, locomotion_tasks, make_config
from sldr_core.training import train

TINY: Settings = {
    "loop": {
        "epochs": 1,
        "cycles_per_epoch": 2,
        "episodes_per_cycle": 2,
        "updates_per_cycle": 2,
        "updates_per_sync": 2,
        "batch_size": 16,
        "test_episodes": 2,
    },
    "agent": {"hidden_sizes": [8, 8]},
}
"""Laid over the smoke preset: two cycles."""

TRAININGS: list[tuple[str, Phase]] = [
    *((task, "manipulation") for task in TASKS),
    *((name, "locomotion") for name, spec in (TASKS | LOCOMOTION_TASKS).items() if name in spec.locomotion_tasks),
]
OF_EACH_KIND = {
    ("FetchStack2", "manipulation"),
    ("FetchTuple3", "locomotion"),
    ("HandBlockFull", "manipulation"),
}
"""Those of the usual run; the slow one goes through all."""


@pytest.mark.parametrize(
    ("task", "phase"),
    [pytest.param(*each, marks=() if each in OF_EACH_KIND else pytest.mark.slow) for each in TRAININGS],
)
def test_a_training_of_the_task_goes_on_to_the_same_bits(task: str, phase: Phase, tmp_path: Path) -> None:
    method = LOCOMOTION_METHOD if phase == "locomotion" else "her-sldr"
    config = make_config(task, phase, method, 0, "smoke", TINY)
    models = tuple(save_untrained_model(tmp_path / f"{name}.pt", name) for name in locomotion_tasks(config))
    run(config, tmp_path / "whole", models)

    # Each call builds everything anew: nothing but the directory goes from one to the next.
    train(config, StoppingRecorder(tmp_path / "parts", 1, "shutdown"), models)
    run(config, tmp_path / "parts", models)

    assert_same_training(tmp_path / "parts", tmp_path / "whole")
    recorded = tmp_path / "whole" / episodes_file(1)
    assert (tmp_path / "parts" / recorded.name).read_bytes() == recorded.read_bytes()
    assert [episode.resimulates for episode in read_episodes(recorded).episodes] == [True, True]
