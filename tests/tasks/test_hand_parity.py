"""The hand's tasks are the same physics as gymnasium-robotics': same state and actions, same trajectory.

Ours differ on purpose in three points, each with a test that says so: a quaternion's sign means nothing, the pen's
roll is ignored in batches too, and the pen has to be within 1 cm (5 cm in the variant `original`).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hand_reference import REFERENCE_IDS, Played, play_ours, play_reference, reference_of

from sldr_core.envs import make_envs
from sldr_core.envs.rotations import multiply_quaternions

STEPS = 100
TOLERANCE = 1e-9
POSES = 400
"""Pairs of poses whose rewards are compared."""

every_task = pytest.mark.parametrize("task", REFERENCE_IDS)
pen_tasks = pytest.mark.parametrize("task", ["HandPenRotate", "HandPenFull"])


def random_actions(episodes: int, seed: int) -> np.ndarray:
    """Return actions `[N, T, 20]` that are held for five steps, so that the fingers reach the object."""
    rng = np.random.default_rng(seed)
    few = rng.uniform(-1.2, 1.2, (episodes, STEPS // 5, 20)).astype(np.float32)
    return np.repeat(few, 5, axis=1)


def play_both(task: str, episodes: int, first_seed: int) -> tuple[Played, Played]:
    actions = random_actions(episodes, first_seed)
    seeds = list(range(first_seed, first_seed + episodes))
    starts, goals, expected = play_reference(reference_of(task), seeds, actions)
    envs = make_envs(task, num_envs=episodes, threads=2, variant="original")
    return play_ours(envs, starts, goals, actions), expected


def assert_equal(ours: Played, expected: Played) -> None:
    moved = np.linalg.norm(expected.achieved[:, -1, :3] - expected.achieved[:, 0, :3], axis=-1)
    assert moved.max() > 0.005, "no object was moved: the test would prove nothing about contacts"
    for name in ("obs", "achieved", "goal"):
        assert np.abs(getattr(ours, name) - getattr(expected, name)).max() <= TOLERANCE, name
    same_sign = (expected.achieved[..., 3:] * expected.goal[..., 3:]).sum(axis=-1) >= 0.0
    np.testing.assert_array_equal(ours.reward[same_sign], expected.reward[same_sign])
    np.testing.assert_array_equal(ours.success[same_sign], expected.success[same_sign])


@every_task
def test_random_episodes_equal_the_reference(task: str) -> None:
    assert_equal(*play_both(task, episodes=2, first_seed=0))


@pytest.mark.slow
@every_task
def test_twenty_random_episodes_equal_the_reference(task: str) -> None:
    for first_seed in range(100, 120, 4):
        assert_equal(*play_both(task, episodes=4, first_seed=first_seed))


def unit(quaternions: np.ndarray) -> np.ndarray:
    return quaternions / np.linalg.norm(quaternions, axis=-1, keepdims=True)


def near_poses(task: str) -> tuple[np.ndarray, np.ndarray]:
    """Return achieved poses and goals `[N, 7]` within and beyond the thresholds; their quaternions agree in sign."""
    rng = np.random.default_rng(0)
    goal = np.concatenate([rng.normal(size=(POSES, 3)), unit(rng.normal(size=(POSES, 4)))], axis=1)
    distance = make_envs(task, variant="original").spec.success_distance or 0.01
    way = unit(rng.normal(size=(POSES, 3))) * rng.uniform(0, 1.5, (POSES, 1)) * distance
    half = rng.uniform(0, 0.09, (POSES, 1))  # [rad]
    turn = np.concatenate([np.cos(half), np.sin(half) * unit(rng.normal(size=(POSES, 3)))], axis=1)
    achieved = np.concatenate([goal[:, :3] + way, multiply_quaternions(turn, goal[:, 3:])], axis=1)
    return achieved, goal


def one_by_one(reference: Any, achieved: np.ndarray, goal: np.ndarray) -> np.ndarray:
    pairs = zip(achieved, goal, strict=True)
    return np.array([reference.compute_reward(a.copy(), g.copy(), {}) for a, g in pairs])


@every_task
def test_rewards_of_poses_near_the_goal_equal_those_the_reference_gives_one_by_one(task: str) -> None:
    achieved, goal = near_poses(task)
    envs = make_envs(task, variant="original")
    expected = one_by_one(reference_of(task), achieved, goal)

    reward, success = envs.reward(achieved, goal), envs.success(achieved, goal)

    # The pen's rotation is put together again from Euler angles, in the reference with another sign at times.
    flipped = one_by_one(reference_of(task), achieved, goal * np.array([1, 1, 1, -1, -1, -1, -1]))
    either = np.maximum(expected, flipped) if "Pen" in task else expected
    np.testing.assert_array_equal(reward, either)
    np.testing.assert_array_equal(success, either == 0)
    assert 0 < (reward == 0).sum() < POSES


@every_task
def test_the_sign_of_a_quaternion_means_nothing_unlike_in_the_reference(task: str) -> None:
    achieved, goal = near_poses(task)
    envs = make_envs(task)
    flipped = goal * np.array([1, 1, 1, -1, -1, -1, -1])

    np.testing.assert_array_equal(envs.reward(achieved, flipped), envs.reward(achieved, goal))
    theirs, envs_success = one_by_one(reference_of(task), achieved, flipped), envs.success(achieved, goal)
    assert (theirs[envs_success] == -1.0).any(), "the reference tells q from -q"


@pen_tasks
def test_the_pens_roll_is_ignored_in_batches_unlike_in_the_reference(task: str) -> None:
    rng = np.random.default_rng(1)
    goal = np.concatenate([rng.normal(size=(5, 3)), unit(rng.normal(size=(5, 4)))], axis=1)
    half = np.array([0.3, 0.6, 0.9, 1.2, 1.5])  # [rad]
    zeros = np.zeros(5)
    roll = np.stack([np.cos(half), zeros, zeros, np.sin(half)], axis=1)
    achieved = np.concatenate([goal[:, :3], multiply_quaternions(goal[:, 3:], roll)], axis=1)

    np.testing.assert_array_equal(make_envs(task).reward(achieved, goal), np.zeros(5))
    assert (reference_of(task).compute_reward(achieved.copy(), goal.copy(), {}) == -1.0).any()


def test_the_pen_of_the_full_task_has_to_be_nearer_than_in_the_reference() -> None:
    achieved = np.array([[1.0, 0.9, 0.15, 1.0, 0.0, 0.0, 0.0]])
    goal = achieved + np.array([0.03, 0, 0, 0, 0, 0, 0])  # [m]

    assert one_by_one(reference_of("HandPenFull"), achieved, goal) == 0.0
    assert make_envs("HandPenFull", variant="original").reward(achieved, goal) == 0.0
    assert make_envs("HandPenFull").reward(achieved, goal) == -1.0
