"""A scene goes on to the last bit from any moment that was kept, in the same process or in another."""

from __future__ import annotations

import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sldr_core.config import LOCOMOTION_TASKS, TASKS, Phase
from sldr_core.envs import Envs, make_envs

SCENES: list[tuple[str, Phase]] = [
    *((task, "manipulation") for task in TASKS),
    *((spec.name, "locomotion") for spec in (TASKS | LOCOMOTION_TASKS).values() if spec.name in spec.locomotion_tasks),
]
ONE_OF_EACH_KIND: list[tuple[str, Phase]] = [
    ("FetchPush", "manipulation"),
    ("FetchStack2", "manipulation"),
    ("FetchTuple3", "locomotion"),
    ("HandBlockRotate", "locomotion"),
]
"""Restored in another process in the usual run; the slow one does so for all."""

EARLIER, LATER = 4, 6
"""Control steps before a state is kept, and after it."""

TIMEOUT_S = 280.0

CODE_OF_THE_OTHER_PROCESS = """
import pickle, sys
from pathlib import Path
from test_restored_scenes import make_envs, go_on
directory = Path(sys.argv[1])
for path in sorted(directory.glob("*.kept")):
    kept = pickle.loads(path.read_bytes())
    envs = make_envs(*kept["scene"], num_envs=2, seed=9)
    envs.restore(kept["state"])
    path.with_suffix(".seen").write_bytes(pickle.dumps(go_on(envs)))
"""


def actions_of(envs: Envs, steps: int, seed: int) -> np.ndarray:
    shape = (steps, envs.num_envs, envs.action_size)
    return np.random.default_rng(seed).uniform(-1.0, 1.0, shape).astype(np.float32)


def go_on(envs: Envs) -> list[np.ndarray]:
    """Return the whole state and all that is seen: now, after each further step, and through the next episode."""
    seen = [envs.simulation.snapshot(), envs.observe().obs, envs.observe().goal]
    for begin in (lambda: None, envs.reset):
        begin()
        for action in actions_of(envs, LATER, seed=1):
            now = envs.step(action)
            seen += [envs.simulation.snapshot(), now.obs, now.achieved, now.goal]
    return seen


def in_the_middle(task: str, phase: Phase) -> Envs:
    """Return a scene whose second episode is under way."""
    envs = make_envs(task, phase, num_envs=2, seed=3)
    envs.reset()
    for action in actions_of(envs, EARLIER, seed=0):
        envs.step(action)
    return envs


def assert_equal(ours: list[np.ndarray], theirs: list[np.ndarray]) -> None:
    for one, other in zip(ours, theirs, strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize(("task", "phase"), SCENES, ids=[f"{task}-{phase}" for task, phase in SCENES])
def test_another_scene_goes_on_from_the_middle_of_an_episode_and_into_the_next(task: str, phase: Phase) -> None:
    envs = in_the_middle(task, phase)
    state = envs.state()
    expected = go_on(envs)
    other = make_envs(task, phase, num_envs=2, seed=9)
    other.step(actions_of(other, 1, seed=5)[0])

    other.restore(state)

    assert_equal(go_on(other), expected)


@pytest.mark.parametrize(
    "scenes", [ONE_OF_EACH_KIND, pytest.param(SCENES, marks=pytest.mark.slow)], ids=["one-of-each-kind", "all"]
)
def test_another_process_goes_on_from_the_middle_of_an_episode(scenes: list[tuple[str, Phase]], tmp_path: Path) -> None:
    expected: dict[str, list[np.ndarray]] = {}
    for task, phase in scenes:
        envs = in_the_middle(task, phase)
        kept = {"scene": (task, phase), "state": envs.state()}
        (tmp_path / f"{task}-{phase}.kept").write_bytes(pickle.dumps(kept))
        expected[f"{task}-{phase}"] = go_on(envs)

    command = [sys.executable, "-c", CODE_OF_THE_OTHER_PROCESS, str(tmp_path)]
    subprocess.run(command, cwd=Path(__file__).parent, check=True, timeout=TIMEOUT_S)

    for name, ours in expected.items():
        assert_equal(pickle.loads((tmp_path / f"{name}.seen").read_bytes()), ours)


def test_a_goal_that_was_set_by_hand_is_kept_before_the_next_step() -> None:
    envs, other = (make_envs("HandEggFull", num_envs=2, seed=seed) for seed in (1, 9))
    envs.set_goal(envs.observe().goal + 0.01)
    other.set_goal(other.observe().goal - 0.02)

    other.restore(envs.state())

    np.testing.assert_array_equal(other.qpos, envs.qpos)
    assert_equal(go_on(other), go_on(envs))


@pytest.mark.parametrize("change", [{"num_envs": 3}, {"task": "FetchStack2"}])
def test_a_state_of_another_scene_is_refused(change: dict[str, Any]) -> None:
    state = make_envs(**{"task": "FetchPush", "num_envs": 2, **change}).state()

    with pytest.raises(ValueError, match="expected a snapshot of shape"):
        make_envs("FetchPush", num_envs=2).restore(state)
