"""The tasks with one object on a table are gymnasium-robotics': same state and actions, same trajectory.

Nothing differs on purpose: starts, goals, thresholds, rewards and success are the reference's.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
import pytest

from sldr_core.config import FetchScene, find_task
from sldr_core.envs import Envs, make_envs
from sldr_core.envs.scenes.fetch import settle_fetch

STEPS = 50
TOLERANCE = 1e-9
PHYSICS = mujoco.mjtState.mjSTATE_INTEGRATION

with warnings.catch_warnings():
    # The reference warns about environments that are not used here.
    warnings.simplefilter("ignore")
    import gymnasium
    import gymnasium_robotics


@dataclass
class Reference:
    """The reference's environment of a task."""

    task: str
    env: Any

    def play(self, seed: int, actions: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the start's state, the goal and what was seen after each step, `[T, ...]`."""
        self.env.reset(seed=seed)
        start = np.empty(mujoco.mj_stateSize(self.env.model, PHYSICS))
        mujoco.mj_getState(self.env.model, self.env.data, start, PHYSICS)
        seen = []
        for action in actions:
            obs, reward, _, _, info = self.env.step(action)
            seen.append(np.concatenate([*obs.values(), [reward, info["is_success"]]]))
        return start, self.env.goal.copy(), np.stack(seen)


@pytest.fixture(scope="module", params=["FetchPush", "FetchSlide", "FetchPickAndPlace"])
def reference(request: pytest.FixtureRequest) -> Iterator[Reference]:
    gymnasium.register_envs(gymnasium_robotics)
    env = gymnasium.make(f"{request.param}-v4", disable_env_checker=True)
    yield Reference(request.param, env.unwrapped)
    env.close()


def play_ours(envs: Envs, starts: np.ndarray, goals: np.ndarray, actions: np.ndarray) -> np.ndarray:
    """Return what was seen after each step, `[N, T, ...]`, of actions `[N, T, A]`."""
    envs.simulation.state[:] = starts
    envs.simulation.forward()
    envs.set_goal(goals)
    seen = []
    for t in range(actions.shape[1]):
        now = envs.step(actions[:, t])
        reward, success = envs.reward(now.achieved, now.goal), envs.success(now.achieved, now.goal)
        # The order of the reference's dictionary: observation, achieved goal, desired goal.
        columns = [now.obs, now.achieved, now.goal, reward[:, None], success[:, None]]
        seen.append(np.concatenate(columns, axis=1, dtype=np.float64))
    return np.stack(seen, axis=1)


def actions_towards(reference: Reference, seeds: range, noise: np.random.Generator) -> np.ndarray:
    """Return actions `[N, T, 4]` that go for the object, then anywhere, opening and closing the fingers."""
    actions = noise.uniform(-1.2, 1.2, (len(seeds), STEPS, 4)).astype(np.float32)
    actions = np.repeat(actions[:, ::10], 10, axis=1)
    for i, seed in enumerate(seeds):
        way = reference.env.reset(seed=seed)[0]["observation"][6:9]
        actions[i, : STEPS // 2, :3] = way / np.abs(way).max()
        actions[i, : STEPS // 2, 2] += 0.02
    return actions


def assert_equal(reference: Reference, seeds: range) -> None:
    actions = actions_towards(reference, seeds, np.random.default_rng(seeds.start))
    played = [reference.play(seed, episode) for seed, episode in zip(seeds, actions, strict=True)]
    starts, goals, expected = (np.stack(part) for part in zip(*played, strict=True))

    ours = play_ours(make_envs(reference.task, num_envs=len(seeds), threads=2), starts, goals, actions)

    moved = np.linalg.norm(ours[:, -1, 3:5] - ours[:, 0, 3:5], axis=1)
    assert moved.max() > 0.02, "no object was moved: the test would prove nothing about contacts"
    assert np.abs(ours - expected).max() <= TOLERANCE


def test_episodes_equal_the_reference(reference: Reference) -> None:
    assert_equal(reference, range(4))


@pytest.mark.slow
def test_twenty_episodes_equal_the_reference(reference: Reference) -> None:
    assert_equal(reference, range(100, 120))


def test_episodes_start_from_the_settled_scene_of_the_reference(reference: Reference) -> None:
    scene = find_task(reference.task).scene
    assert isinstance(scene, FetchScene)

    settled = settle_fetch(scene)

    np.testing.assert_array_equal(settled.gripper_pos, reference.env.initial_gripper_xpos)
    np.testing.assert_array_equal(settled.qpos, reference.env.initial_qpos)
    np.testing.assert_array_equal(settled.qvel, reference.env.initial_qvel)
    assert settled.object_height == reference.env.height_offset


def test_starts_and_goals_are_drawn_from_the_reference_s_ranges(reference: Reference) -> None:
    scene = find_task(reference.task).scene
    assert isinstance(scene, FetchScene)
    env = reference.env

    assert (scene.object_range, scene.target_range) == (env.obj_range, env.target_range)
    np.testing.assert_array_equal(scene.target_offset, np.zeros(3) + env.target_offset)
    assert (scene.target_in_the_air, scene.gripper_blocked) == (env.target_in_the_air, env.block_gripper)
    assert find_task(reference.task).success_distance == env.distance_threshold


def test_rewards_of_any_goals_equal_the_reference(reference: Reference) -> None:
    rng = np.random.default_rng(0)
    achieved = rng.normal(size=(1000, 3))
    goal = achieved + rng.uniform(-0.05, 0.05, achieved.shape)

    ours = make_envs(reference.task).reward(achieved, goal)

    np.testing.assert_array_equal(ours, reference.env.compute_reward(achieved, goal, {}))
    assert 0 < (ours == 0).sum() < ours.size
