"""Where episodes in the hand start and what they are to reach."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import mujoco
import numpy as np
import psutil
import pytest
from hand_play import LOCOMOTION_TASKS, MANIPULATION_TASKS, pose_slice

from sldr_core.config import HandScene, Phase, find_task
from sldr_core.envs import Envs, make_envs
from sldr_core.envs.hand import TARGET_ASIDE, HandStarts
from sldr_core.envs.rotations import angle_between
from sldr_core.envs.scenes.hand import build_hand
from sldr_core.envs.simulation import Simulation

TARGET_LOW, TARGET_HIGH = np.array([-0.04, -0.06, 0.0]), np.array([0.04, 0.02, 0.06])  # [m]
PALM_HEIGHT = 0.13
"""An object's centre is above this as long as it lies on the palm or the fingers [m]."""
DEEPEST = 0.004
"""The soft contacts give way by less than this [m]."""
MEGABYTE = 2**20

ACTORS = [
    *(pytest.param(task, "manipulation", id=f"{task}-manipulation") for task in MANIPULATION_TASKS),
    *(pytest.param(task, "locomotion", id=f"{task}-locomotion") for task in LOCOMOTION_TASKS),
]
every_actor = pytest.mark.parametrize(("task", "phase"), ACTORS)
every_task = pytest.mark.parametrize(("task", "phase"), [*ACTORS[:6], *ACTORS[9:]])


def starts_of(envs: Envs, resets: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the poses, velocities and goals of many starts."""
    poses, speeds, goals = [], [], []
    first = pose_slice(envs).start
    for _ in range(resets):
        now = envs.reset()
        poses.append(now.achieved)
        speeds.append(envs.qvel[:, first : first + 6].copy())
        goals.append(now.goal)
    return np.concatenate(poses), np.concatenate(speeds), np.concatenate(goals)


def assert_distributed_as_described(task: str, envs: Envs, resets: int) -> None:
    scene = find_task(task).scene
    assert isinstance(scene, HandScene)
    poses, speeds, goals = starts_of(envs, resets)
    place, way = poses[:, :3], goals[:, :3] - poses[:, :3]
    turn = angle_between(goals[:, 3:], poses[:, 3:])
    print(f"\n{task}: {len(poses)} starts")
    for name, values in (("start [m]", place), ("way to the goal [m]", way), ("turn to the goal [rad]", turn)):
        print(f"  {name}: mean {values.mean(axis=0)}, from {values.min(axis=0)} to {values.max(axis=0)}")

    assert np.abs(place[:, :2] - [1.005, 0.872]).max() < 0.035, "out of the palm"
    assert place[:, 2].min() > PALM_HEIGHT, "fallen"
    assert np.abs(speeds[:, :3]).max() < 0.5, "falling"  # [m/s]
    np.testing.assert_allclose(np.linalg.norm(poses[:, 3:], axis=1), 1.0, atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(goals[:, 3:], axis=1), 1.0, atol=1e-6)
    if scene.target_position == "ignore":
        np.testing.assert_array_equal(way, 0.0)
    else:
        assert (way >= TARGET_LOW).all()
        assert (way <= TARGET_HIGH).all()
        deviation = np.ptp([TARGET_LOW, TARGET_HIGH], axis=0) / np.sqrt(12 * len(way))
        assert (np.abs(way.mean(axis=0) - (TARGET_LOW + TARGET_HIGH) / 2) < 4 * deviation).all()
    if scene.target_rotation == "ignore":
        np.testing.assert_array_equal(goals[:, 3:], poses[:, 3:])
    else:
        assert (goals[:, 3] >= 0.0).all()
        goal_angle = 2 * np.arccos(goals[:, 3])  # the size of an angle uniform in [-pi, pi]
        assert abs(goal_angle.mean() - np.pi / 2) < 4 * np.pi / np.sqrt(12 * len(goals))
    spread = angle_between(poses[:, 3:], poses[:1, 3:])
    assert (spread.max() > 2.0) == scene.start_rotation_random  # [rad]


def deepest_penetration(envs: Envs) -> float:
    """Return how far the object enters anything, at most, over the simulations [m]."""
    model, data, deepest = envs.model, mujoco.MjData(envs.model), 0.0
    body = model.body("object").id
    for qpos in envs.qpos:
        data.qpos[:] = qpos
        mujoco.mj_forward(model, data)
        touching = (model.geom_bodyid[data.contact.geom] == body).any(axis=1)
        deepest = max(deepest, -data.contact.dist[touching].min(initial=0.0))
    return deepest


@every_task
def test_starts_and_goals_lie_where_the_task_says(task: str, phase: Phase) -> None:
    envs = make_envs(task, phase, num_envs=24, threads=2)

    assert_distributed_as_described(task, envs, resets=1)
    assert deepest_penetration(envs) < DEEPEST


@pytest.mark.slow
@every_task
def test_ten_thousand_starts_and_goals_lie_where_the_task_says(task: str, phase: Phase) -> None:
    envs = make_envs(task, phase, num_envs=250, threads=2)

    assert_distributed_as_described(task, envs, resets=40)
    assert deepest_penetration(envs) < DEEPEST


def hand_starts(num_envs: int, **changes: Any) -> HandStarts:
    scene = find_task("HandEggRotate").scene
    assert isinstance(scene, HandScene)
    return HandStarts(replace(scene, **changes), Simulation(build_hand(scene, False, 1.0), num_envs, 2))


def test_starts_that_lie_too_low_are_drawn_again_each_from_its_own_generator() -> None:
    # Half of all eggs come to rest below this: many have to be drawn again, some more than once.
    low = 0.165  # [m]
    heights = slice(24 + 2, 24 + 3)
    together = hand_starts(8, min_height=low).draw([np.random.default_rng((7, index)) for index in range(8)])

    assert (together.qpos[:, heights] > low).all()
    single = hand_starts(1, min_height=low)
    for index in range(8):
        alone = single.draw([np.random.default_rng((7, index))])
        np.testing.assert_array_equal(together.qpos[index], alone.qpos[0])
        np.testing.assert_array_equal(together.qvel[index], alone.qvel[0])
        np.testing.assert_array_equal(together.goal[index], alone.goal[0])
    first_try = hand_starts(8).draw([np.random.default_rng((7, index)) for index in range(8)])
    assert 0 < (first_try.qpos[:, heights] <= low).sum() < 8, "nothing was drawn again, or everything"


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_simulations_of_a_batch_start_as_they_do_alone(threads: int) -> None:
    batch = make_envs("HandBlockFull", num_envs=3, seed=4, threads=threads)
    first = make_envs("HandBlockFull", num_envs=1, seed=4)

    for _ in range(2):
        together, alone = batch.reset(), first.reset()
        np.testing.assert_array_equal(together.obs[0], alone.obs[0])
        np.testing.assert_array_equal(together.goal[0], alone.goal[0])


def test_some_simulations_start_anew_and_the_others_go_on_as_if_nothing_had_happened() -> None:
    envs, undisturbed = (make_envs("HandPenFull", "manipulation", num_envs=3, seed=2) for _ in range(2))
    actions = np.random.default_rng(0).uniform(-1, 1, (8, 3, 20)).astype(np.float32)
    for action in actions[:4]:
        envs.step(action)
        undisturbed.step(action)

    envs.reset([1])
    for action in actions[4:]:
        after, expected = envs.step(action), undisturbed.step(action)

    np.testing.assert_array_equal(after.obs[[0, 2]], expected.obs[[0, 2]])
    assert (after.obs[1] != expected.obs[1]).any()


@pytest.mark.parametrize(("task", "aside"), [("HandBlockFull", np.zeros(3)), ("HandBlockRotate", TARGET_ASIDE)])
def test_the_target_stands_at_the_goal_and_stays_there(task: str, aside: np.ndarray) -> None:
    envs = make_envs(task, num_envs=2)
    envs.set_goal([0.9, 0.8, 0.3, 0.0, 1.0, 0.0, 0.0], ids=[1])
    goal = envs.observe().goal
    target = int(envs.model.joint("target:joint").qposadr[0])

    for _ in range(5):
        envs.step(np.zeros((2, 20)))

    np.testing.assert_allclose(envs.qpos[:, target : target + 3], goal[:, :3] + aside, atol=1e-9)
    np.testing.assert_allclose(envs.qpos[:, target + 3 : target + 7], goal[:, 3:], atol=1e-9)


def growth_over(envs: Envs, resets: int) -> float:
    """Return by how much memory grows [MB] over many resets, each with a step."""
    process, action = psutil.Process(), np.zeros((envs.num_envs, envs.action_size))
    for _ in range(20):
        envs.reset()
        envs.step(action)
    before = process.memory_info().rss
    for _ in range(resets):
        envs.reset()
        envs.step(action)
    return (process.memory_info().rss - before) / MEGABYTE


def test_memory_stays_flat_over_resets() -> None:
    assert growth_over(make_envs("HandEggFull"), resets=30) < 2.0


@pytest.mark.slow
@every_actor
def test_memory_stays_flat_over_a_thousand_resets(task: str, phase: Phase) -> None:
    assert growth_over(make_envs(task, phase), resets=1000) < 2.0
