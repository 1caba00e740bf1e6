"""The moments that are drawn: those of a recorded episode, or of one that a policy makes now.

`T` steps.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray

from sldr_core.config import TrainConfig, config_from_dict
from sldr_core.envs import Envs, make_envs
from sldr_core.episodes import episodes_file, read_episodes
from sldr_core.errors import BadFile
from sldr_core.training import load_policy
from worker.viewer.camera import Camera, find_camera

EPISODES_SUFFIX = Path(episodes_file(0)).suffix
"""What the names of recorded episodes end with; every other source holds a policy."""


@dataclass(frozen=True)
class Moments:
    """An episode as it is drawn."""

    model: mujoco.MjModel
    camera: Camera
    qpos: NDArray[np.float64]
    """Joint positions, `[T+1, nq]`."""
    goal: NDArray[np.float64]
    """The task's goal, `[G]`."""


def find_moments(source: Path, number: int) -> Moments:
    """Return what is drawn from a file.

    Args:
        source: a file of recorded episodes, or one that holds a policy.
        number: the episode's number in its test, or the seed of start and goal.

    Raises:
        BadFile: the file holds neither, or not that episode.
    """
    return recorded_moments(source, number) if source.suffix == EPISODES_SUFFIX else policy_moments(source, number)


def recorded_moments(path: Path, index: int) -> Moments:
    """Return the moments of a recorded episode.

    Raises:
        BadFile: the file cannot be read, or has no such episode.
    """
    test = read_episodes(path)
    episode = next((episode for episode in test.episodes if episode.index == index), None)
    if episode is None:
        there = ", ".join(str(episode.index) for episode in test.episodes)
        raise BadFile(f"{path.name} has no episode {index}; it has {there}.")
    config = config_from_dict(dict(test.origin.config))
    return _moments(config, _envs(config, seed=0), episode.qpos, episode.goal)


def policy_moments(path: Path, seed: int) -> Moments:
    """Return the moments of one episode of a policy, acting without noise.

    Raises:
        BadFile: the file holds no usable policy.
    """
    policy = load_policy(path)
    envs = _envs(policy.config, seed)
    seen = envs.reset()
    qpos, goal = [envs.qpos[0].copy()], seen.goal[0].copy()
    for _ in range(envs.episode_length):
        seen = envs.step(policy.act(seen.obs, seen.goal))
        qpos.append(envs.qpos[0].copy())
    return _moments(policy.config, envs, np.stack(qpos), goal)


def _envs(config: TrainConfig, seed: int) -> Envs:
    scene = config.scene
    return make_envs(
        config.task, config.phase, seed=seed, robot=scene.locomotion_robot, testing=True, variant=scene.variant
    )


def _moments(config: TrainConfig, envs: Envs, qpos: NDArray[np.float64], goal: NDArray[np.float64]) -> Moments:
    if qpos.shape[1] != envs.model.nq:
        raise BadFile(f"The episode has {qpos.shape[1]} joint positions, and {config.task} has {envs.model.nq}.")
    return Moments(envs.model, find_camera(config.task_spec, config.phase), qpos, goal)
