"""FetchPush is the same physics as gymnasium-robotics': same state and actions, same trajectory."""

from __future__ import annotations

import warnings
from typing import Any

import mujoco
import numpy as np
import pytest

from sldr_core.config import FetchScene, find_task
from sldr_core.envs import Envs, make_envs
from sldr_core.envs.scenes.fetch import settle_fetch

SIDE_BY_SIDE = 4
"""Reference episodes run in one batch of ours."""
BATCHES = 5
STEPS = 50
TOLERANCE = 1e-9

with warnings.catch_warnings():
    # The reference warns about environments that are not used here.
    warnings.simplefilter("ignore")
    import gymnasium
    import gymnasium_robotics


@pytest.fixture(scope="module")
def reference() -> Any:
    gymnasium.register_envs(gymnasium_robotics)
    env = gymnasium.make("FetchPush-v4", disable_env_checker=True)
    yield env.unwrapped
    env.close()


@pytest.fixture(scope="module")
def envs() -> Envs:
    return make_envs("FetchPush", num_envs=SIDE_BY_SIDE, threads=2)


def integration_state(env: Any) -> np.ndarray:
    kind = mujoco.mjtState.mjSTATE_INTEGRATION
    state = np.empty(mujoco.mj_stateSize(env.model, kind))
    mujoco.mj_getState(env.model, env.data, state, kind)
    return state


def row(obs: dict[str, np.ndarray], reward: float, success: float) -> np.ndarray:
    return np.concatenate([obs["observation"], obs["achieved_goal"], obs["desired_goal"], [reward, success]])


def play_reference(env: Any, seed: int, actions: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return start state, goal and what was seen after each step, `[T, ...]`."""
    env.reset(seed=seed)
    start, goal = integration_state(env), env.goal.copy()
    seen = []
    for action in actions:
        obs, reward, _, _, info = env.step(action)
        seen.append(row(obs, float(reward), float(info["is_success"])))
    return start, goal, np.stack(seen)


def play_ours(envs: Envs, starts: np.ndarray, goals: np.ndarray, actions: np.ndarray) -> np.ndarray:
    """Return what was seen after each step, `[N, T, ...]`, of actions `[N, T, A]`."""
    envs.simulation.state[:] = starts
    envs.simulation.forward()
    envs.set_goal(goals)
    seen = []
    for t in range(actions.shape[1]):
        now = envs.step(actions[:, t])
        reward, success = envs.reward(now.achieved, now.goal), envs.success(now.achieved, now.goal)
        columns = [now.obs, now.achieved, now.goal, reward[:, None], success[:, None]]
        seen.append(np.concatenate(columns, axis=1, dtype=np.float64))
    return np.stack(seen, axis=1)


@pytest.mark.parametrize("batch", range(BATCHES))
def test_random_episodes_equal_the_reference(reference: Any, envs: Envs, batch: int) -> None:
    rng = np.random.default_rng(batch)
    actions = rng.uniform(-1.2, 1.2, (SIDE_BY_SIDE, STEPS, 4)).astype(np.float32)
    # Long pushes in one direction bring the gripper to the block more often than noise does.
    actions[:, :, :3] = np.repeat(actions[:, ::10, :3], 10, axis=1)
    played = [play_reference(reference, 100 * batch + i, actions[i]) for i in range(SIDE_BY_SIDE)]
    starts, goals, expected = (np.stack(part) for part in zip(*played, strict=True))

    ours = play_ours(envs, starts, goals, actions)

    assert np.abs(ours - expected).max() <= TOLERANCE


def test_pushing_the_block_equals_the_reference(reference: Any, envs: Envs) -> None:
    actions = np.zeros((SIDE_BY_SIDE, STEPS, 4), dtype=np.float32)
    for i in range(SIDE_BY_SIDE):
        obs, _ = reference.reset(seed=i)
        way = obs["observation"][6:8]
        actions[i, :, :2], actions[i, :, 2] = way / np.abs(way).max(), -0.02
    played = [play_reference(reference, i, actions[i]) for i in range(SIDE_BY_SIDE)]
    starts, goals, expected = (np.stack(part) for part in zip(*played, strict=True))

    ours = play_ours(envs, starts, goals, actions)

    moved = np.linalg.norm(ours[:, -1, 3:5] - ours[:, 0, 3:5], axis=1)
    assert moved.max() > 0.05, "no block was pushed: the test would prove nothing about contacts"
    assert np.abs(ours - expected).max() <= TOLERANCE


def test_episodes_start_from_the_settled_scene_of_the_reference(reference: Any) -> None:
    scene = find_task("FetchPush").scene
    assert isinstance(scene, FetchScene)

    settled = settle_fetch(scene)

    np.testing.assert_array_equal(settled.gripper_pos, reference.initial_gripper_xpos)
    np.testing.assert_array_equal(settled.qpos, reference.initial_qpos)
    np.testing.assert_array_equal(settled.qvel, reference.initial_qvel)
    assert settled.object_height == reference.height_offset


def test_a_start_at_the_same_place_is_seen_as_in_the_reference(reference: Any) -> None:
    expected, _ = reference.reset(seed=3)
    envs = make_envs("FetchPush")
    qpos, qvel = reference.data.qpos[None].copy(), reference.data.qvel[None].copy()

    envs.simulation.reset(np.array([0]), qpos, qvel)

    assert np.abs(envs.observe().obs[0] - expected["observation"]).max() <= TOLERANCE


def test_rewards_of_any_goals_equal_the_reference(reference: Any) -> None:
    rng = np.random.default_rng(0)
    achieved = rng.normal(size=(1000, 3))
    goal = achieved + rng.uniform(-0.05, 0.05, achieved.shape)

    ours = make_envs("FetchPush").reward(achieved, goal)

    np.testing.assert_array_equal(ours, reference.compute_reward(achieved, goal, {}))
    assert 0 < (ours == 0).sum() < ours.size
