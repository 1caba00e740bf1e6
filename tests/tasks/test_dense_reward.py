"""The dense reward is the reference's, but for quaternions' signs and the pen's roll, where the reference errs."""

from __future__ import annotations

import warnings
from math import cos, pi, sin, sqrt
from typing import Any

import numpy as np
import pytest

from sldr_core.config import PoseGoal, PositionGoals, find_task
from sldr_core.envs import make_envs
from sldr_core.envs.rewards import dense_reward, goal_gaps, remaining_distance
from sldr_core.errors import UnknownName

with warnings.catch_warnings():
    # The reference warns about environments that are not used here.
    warnings.simplefilter("ignore")
    import gymnasium
    import gymnasium_robotics

REFERENCE_IDS = {
    "FetchPush": "FetchPushDense-v4",
    "FetchSlide": "FetchSlideDense-v4",
    "FetchPickAndPlace": "FetchPickAndPlaceDense-v4",
    "HandEggRotate": "HandManipulateEggRotateDense-v1",
    "HandBlockRotate": "HandManipulateBlockRotateXYZDense-v1",
    "HandPenRotate": "HandManipulatePenRotateDense-v1",
    "HandEggFull": "HandManipulateEggFullDense-v1",
    "HandBlockFull": "HandManipulateBlockFullDense-v1",
    "HandPenFull": "HandManipulatePenFullDense-v1",
}
GOALS = 50
POSE = PoseGoal(distance=0.01, angle=0.1)


def random_goals(task: str, seed: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    goals = rng.normal(size=(GOALS, find_task(task).goal_size))
    if task.startswith("Hand"):
        goals[:, 3:] /= np.linalg.norm(goals[:, 3:], axis=1, keepdims=True)
    return goals


def reference_rewards(task: str, achieved: np.ndarray, goals: np.ndarray) -> np.ndarray:
    """Return the reference's rewards one by one, as it errs on batches of pens."""
    gymnasium.register_envs(gymnasium_robotics)
    env: Any = gymnasium.make(REFERENCE_IDS[task], disable_env_checker=True).unwrapped
    rewards = np.array([env.compute_reward(a, g, {}) for a, g in zip(achieved, goals, strict=True)])
    env.close()
    return rewards


def with_the_shorter_turn(task: str, rewards: np.ndarray, achieved: np.ndarray, goals: np.ndarray) -> np.ndarray:
    """Return rewards in which an angle beyond pi, of quaternions of opposite signs, counts as its rest to 2 pi."""
    moved = 10.0 * np.linalg.norm((achieved - goals)[:, :3], axis=1) if "Full" in task else np.zeros(GOALS)
    angle = -rewards - moved
    return -(moved + np.minimum(angle, 2 * pi - angle))


@pytest.mark.parametrize("task", REFERENCE_IDS)
def test_the_dense_reward_is_that_of_the_reference(task: str) -> None:
    achieved, goals = random_goals(task, 0), random_goals(task, 1)
    achieved[0] = goals[0]

    rewards = make_envs(task, reward="dense").reward(achieved, goals)

    expected = reference_rewards(task, achieved, goals)
    if task.startswith("Hand"):
        expected = with_the_shorter_turn(task, expected, achieved, goals)
    np.testing.assert_allclose(rewards, expected, atol=1e-6)
    assert rewards.dtype == np.float32


@pytest.mark.parametrize(("task", "blocks"), [("FetchStack2", 2), ("FetchTuple5", 5)])
def test_several_objects_are_as_far_as_one_norm_over_all_of_them(task: str, blocks: int) -> None:
    envs = make_envs(task, num_envs=2, reward="dense")
    goals = np.zeros((3, 3 * blocks))
    achieved = goals + np.array([0.0, 0.1, -0.3])[:, None]

    rewards = envs.reward(achieved, goals)

    np.testing.assert_allclose(rewards, [0.0, -0.1 * sqrt(3 * blocks), -0.3 * sqrt(3 * blocks)], atol=1e-6)


def turned_about_x(angle: float) -> list[float]:
    return [cos(angle / 2), sin(angle / 2), 0.0, 0.0]


def test_a_pose_by_hand_whatever_the_sign_of_its_quaternion() -> None:
    goal = np.array([[0.0, 0.0, 0.0, *turned_about_x(0.0)]] * 2)
    achieved = np.array([[0.03, 0.0, 0.04, *turned_about_x(0.7)]] * 2)
    achieved[1, 3:] *= -1

    np.testing.assert_allclose(dense_reward(POSE, achieved, goal), [-1.2, -1.2], atol=1e-6)


def test_what_is_not_scored_is_free() -> None:
    goal = np.array([0.0, 0.0, 0.0, *turned_about_x(0.0)])
    achieved = np.array([0.3, 0.0, 0.4, *turned_about_x(0.7)])

    assert dense_reward(PoseGoal(distance=None, angle=0.1), achieved, goal) == pytest.approx(-0.7)
    assert dense_reward(PoseGoal(distance=0.1, angle=None), achieved, goal) == pytest.approx(-5.0)


def test_a_pen_may_roll() -> None:
    goal = np.array([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]])
    rolled = np.array([[0.0, 0.0, 0.0, cos(0.6), 0.0, 0.0, sin(0.6)]])

    assert make_envs("HandPenRotate", reward="dense").reward(rolled, goal) == pytest.approx(0.0, abs=1e-6)
    assert make_envs("HandBlockRotate", reward="dense").reward(rolled, goal) == pytest.approx(-1.2)


def test_success_is_the_same_with_both_rewards() -> None:
    achieved, goals = random_goals("HandBlockFull", 0), random_goals("HandBlockFull", 1)
    achieved[::2] = goals[::2]
    sparse, dense = (make_envs("HandBlockFull", reward=kind) for kind in ("sparse", "dense"))

    np.testing.assert_array_equal(sparse.success(achieved, goals), dense.success(achieved, goals))
    np.testing.assert_array_equal(sparse.reward(achieved, goals) == 0.0, sparse.success(achieved, goals))


def test_a_reward_that_does_not_exist_is_named() -> None:
    with pytest.raises(UnknownName, match=r"No reward is called 'dens'\. Did you mean 'dense'"):
        make_envs("FetchPush", reward="dens")  # pyright: ignore[reportArgumentType]


def test_gaps_are_the_distances_of_all_pairs_by_what_is_scored() -> None:
    rng = np.random.default_rng(0)
    goals, others = (random_goals("HandBlockFull", seed)[: 3 * n].reshape(3, n, 7) for seed, n in ((0, 4), (1, 5)))
    others[0, 0] = goals[0, 0]

    both, turned, moved = (
        goal_gaps(PoseGoal(distance=distance, angle=angle), goals, others)
        for distance, angle in ((1, 1), (None, 1), (1, None))
    )

    for group, i, j in zip(*(rng.integers(high, size=20) for high in (3, 4, 5)), strict=True):
        a, b = goals[group, i], others[group, j]
        way = np.linalg.norm(a[:3] - b[:3])
        turn = min(np.linalg.norm(a[3:] - b[3:]), np.linalg.norm(a[3:] + b[3:]))
        expected = [np.hypot(way, turn), turn, way]
        np.testing.assert_allclose([gaps[group, i, j] for gaps in (both, turned, moved)], expected, atol=1e-7)
    assert both[0, 0, 0] < 1e-7
    blocks = goal_gaps(PositionGoals(distance=0.05, objects=2), goals[..., :6], others[..., :6])
    assert blocks[1, 2, 3] == pytest.approx(np.linalg.norm(goals[1, 2, :6] - others[1, 3, :6]))


@pytest.mark.parametrize(("distance", "angle"), [(1.0, 1.0), (None, 1.0), (1.0, None)])
def test_the_remaining_distance_of_poses_is_their_gap(distance: float | None, angle: float | None) -> None:
    criterion = PoseGoal(distance=distance, angle=angle)
    achieved, goals = random_goals("HandBlockFull", 0), random_goals("HandBlockFull", 1)

    remaining = remaining_distance(criterion, achieved, goals)

    np.testing.assert_allclose(remaining, goal_gaps(criterion, achieved, goals).diagonal(), atol=1e-12)


def test_the_remaining_distance_knows_neither_the_sign_of_a_quaternion_nor_a_pen_s_roll() -> None:
    goal = np.array([0.3, 0.0, 0.4, 1.0, 0.0, 0.0, 0.0])
    rolled = np.array([0.3, 0.0, 0.4, cos(0.6), 0.0, 0.0, sin(0.6)])
    block, pen = (find_task(task).goal for task in ("HandBlockFull", "HandPenFull"))

    assert remaining_distance(block, goal * [1, 1, 1, -1, -1, -1, -1], goal) == pytest.approx(0.0, abs=1e-6)
    assert remaining_distance(block, rolled, goal) == pytest.approx(2.0 * sin(0.3))
    assert remaining_distance(pen, rolled, goal) == pytest.approx(0.0, abs=1e-6)


def test_the_remaining_distance_of_positions_is_the_norm_to_the_last_bit() -> None:
    achieved, goals = (np.random.default_rng(seed).normal(size=(GOALS, 6)) for seed in (0, 1))

    remaining = remaining_distance(PositionGoals(distance=0.05, objects=2), achieved, goals)

    np.testing.assert_array_equal(remaining, np.linalg.norm(achieved - goals, axis=1))
