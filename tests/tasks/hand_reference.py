"""gymnasium-robotics' own hand environments, played beside ours from the same states."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import mujoco
import numpy as np

from sldr_core.envs import Envs

with warnings.catch_warnings():
    # The reference warns about environments that are not used here.
    warnings.simplefilter("ignore")
    import gymnasium
    import gymnasium_robotics

REFERENCE_IDS = {
    "HandEggRotate": "HandManipulateEggRotate-v1",
    "HandBlockRotate": "HandManipulateBlockRotateXYZ-v1",
    "HandPenRotate": "HandManipulatePenRotate-v1",
    "HandEggFull": "HandManipulateEggFull-v1",
    "HandBlockFull": "HandManipulateBlockFull-v1",
    "HandPenFull": "HandManipulatePenFull-v1",
}


@dataclass(frozen=True)
class Played:
    """What was seen of `N` episodes of `T` steps."""

    obs: np.ndarray
    """`[N, T, 61]`."""
    achieved: np.ndarray
    """`[N, T, 7]`."""
    goal: np.ndarray
    """`[N, T, 7]`."""
    reward: np.ndarray
    """`[N, T]`."""
    success: np.ndarray
    """`[N, T]`."""


@lru_cache(maxsize=len(REFERENCE_IDS))
def reference_of(task: str) -> Any:
    gymnasium.register_envs(gymnasium_robotics)
    return gymnasium.make(REFERENCE_IDS[task], disable_env_checker=True).unwrapped


def integration_state(env: Any) -> np.ndarray:
    kind = mujoco.mjtState.mjSTATE_INTEGRATION
    state = np.empty(mujoco.mj_stateSize(env.model, kind))
    mujoco.mj_getState(env.model, env.data, state, kind)
    return state


def play_reference(env: Any, seeds: list[int], actions: np.ndarray) -> tuple[np.ndarray, np.ndarray, Played]:
    """Return start states `[N, S]`, goals `[N, 7]` and what was seen of episodes with actions `[N, T, 20]`."""
    starts, goals, episodes = [], [], []
    for seed, episode_actions in zip(seeds, actions, strict=True):
        env.reset(seed=seed)
        starts.append(integration_state(env))
        goals.append(env.goal.copy())
        steps = []
        for action in episode_actions:
            obs, reward, _, _, info = env.step(action)
            steps.append((obs["observation"], obs["achieved_goal"], obs["desired_goal"], reward, info["is_success"]))
        episodes.append([np.stack(column) for column in zip(*steps, strict=True)])
    return np.stack(starts), np.stack(goals), Played(*(np.stack(column) for column in zip(*episodes, strict=True)))


def play_ours(envs: Envs, starts: np.ndarray, goals: np.ndarray, actions: np.ndarray) -> Played:
    """Return what was seen of episodes with actions `[N, T, 20]` from the reference's states."""
    envs.simulation.state[:] = starts
    envs.simulation.forward()
    envs.simulation.state[:] = starts
    envs.set_goal(goals)
    steps = []
    for t in range(actions.shape[1]):
        now = envs.step(actions[:, t])
        reward, success = envs.reward(now.achieved, now.goal), envs.success(now.achieved, now.goal)
        steps.append((now.obs, now.achieved, now.goal, reward, success))
    return Played(*(np.stack(column, axis=1) for column in zip(*steps, strict=True)))
