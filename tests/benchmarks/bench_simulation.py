"""Simulation: collecting episodes, against gymnasium's own vector environments and against bare physics."""

from __future__ import annotations

import statistics
from collections.abc import Iterator
from functools import partial

import gymnasium as gym
import numpy as np
from bench_rows import REPETITIONS, Measured, Stopwatch, Target, row, seconds_of, time_pairs

from sldr_core.config import Robot
from sldr_core.envs import Envs, make_envs
from sldr_core.processor import count_cores

SIMULATIONS = 38
"""As many as a cycle of the paper collects."""

PEER_WORKERS = 2
"""Processes of gymnasium's `AsyncVectorEnv`, one for each core."""

KNOWN_TASKS = {
    "FetchPush": "FetchPush-v4",
    "FetchSlide": "FetchSlide-v4",
    "FetchPickAndPlace": "FetchPickAndPlace-v4",
    "HandEggRotate": "HandManipulateEggRotate-v1",
    "HandBlockRotate": "HandManipulateBlockRotateXYZ-v1",
    "HandPenRotate": "HandManipulatePenRotate-v1",
    "HandEggFull": "HandManipulateEggFull-v1",
    "HandBlockFull": "HandManipulateBlockFull-v1",
    "HandPenFull": "HandManipulatePenFull-v1",
}
"""The tasks that gymnasium-robotics has as well, with its names."""

FETCH_LOCOMOTION = ("FetchPush", "FetchSlide", "FetchPickAndPlace")


def measure_collecting() -> Iterator[Measured]:
    """Collect episodes of every known task, with observations, rewards and success."""
    for task, peer_id in KNOWN_TASKS.items():
        yield _against_gymnasium(task, peer_id)
        yield _against_physics(task)


def measure_locomotion_scenes() -> Iterator[Measured]:
    """Step the scene without the robot, and the same with it."""
    yield from map(_without_robot, FETCH_LOCOMOTION)


def _without_robot(task: str) -> Measured:
    alone, beside = _locomotion_envs(task, "absent"), _locomotion_envs(task, "still")
    pairs = time_pairs(lambda: run_episode(alone), lambda: run_episode(beside))
    rate = SIMULATIONS * alone.episode_length / statistics.median(pairs.ours)
    return row(
        f"{task}, locomotion: scene without robot against with",
        "x",
        pairs.speedups,
        Target("at least", 3.0),
        f"{rate:,.0f} control steps/s without the robot",
    )


def _against_gymnasium(task: str, peer_id: str) -> Measured:
    envs = make_envs(task, num_envs=SIMULATIONS, seed=0, threads=count_cores())
    # Forked workers would inherit the threads of our simulations as objects without threads, and crash ending them.
    peer = gym.vector.AsyncVectorEnv(
        [partial(gym.make, f"gymnasium_robotics:{peer_id}")] * PEER_WORKERS, context="spawn"
    )
    rng = np.random.default_rng(0)

    def run_peer() -> None:
        peer.reset()
        for _ in range(envs.episode_length):
            peer.step(rng.uniform(-1.0, 1.0, (PEER_WORKERS, envs.action_size)).astype(np.float32))

    try:
        pairs = time_pairs(lambda: run_episode(envs), run_peer)
    finally:
        peer.close()
    steps, peer_steps = SIMULATIONS * envs.episode_length, PEER_WORKERS * envs.episode_length
    ratios = [steps / peer_steps * speedup for speedup in pairs.speedups]
    return row(
        f"{task}: collecting, against AsyncVectorEnv",
        "x",
        ratios,
        Target("at least", 2.0),
        f"{steps / statistics.median(pairs.ours):,.0f} against {peer_steps / statistics.median(pairs.theirs):,.0f} "
        "control steps/s",
    )


def _against_physics(task: str) -> Measured:
    """Measure which share of collecting is mjbatch's stepping, in the same episodes."""
    envs = make_envs(task, num_envs=SIMULATIONS, seed=0, threads=count_cores())
    stepping, bringing = Stopwatch(), Stopwatch()
    envs.simulation.step = stepping.around(envs.simulation.step)
    envs.simulation.forward_motion = bringing.around(envs.simulation.forward_motion)
    _run_steps(envs)
    shares: list[float] = []
    forward: list[float] = []
    for _ in range(REPETITIONS):
        stepping.total_s = bringing.total_s = 0.0
        whole_s = seconds_of(lambda: _run_steps(envs))
        shares.append(stepping.total_s / whole_s)
        forward.append(bringing.total_s / whole_s)
    further = statistics.median(forward)
    told = (
        f"; {further:.3f} more is bringing positions up to date after each step, as in gymnasium-robotics"
        if further
        else ""
    )
    return row(
        f"{task}: collecting, against mjbatch stepping alone",
        "x",
        shares,
        Target("at least", 0.92),
        f"share of an episode's time that is physics{told}",
    )


def run_episode(envs: Envs) -> None:
    """Run one episode of random actions in each simulation, with observations, rewards and success."""
    envs.reset()
    _run_steps(envs)


def _run_steps(envs: Envs) -> None:
    rng = np.random.default_rng(0)
    for _ in range(envs.episode_length):
        seen = envs.step(rng.uniform(-1.0, 1.0, (envs.num_envs, envs.action_size)).astype(np.float32))
        envs.reward(seen.achieved, seen.goal)
        envs.success(seen.achieved, seen.goal)


def _locomotion_envs(task: str, robot: Robot) -> Envs:
    return make_envs(task, "locomotion", num_envs=SIMULATIONS, seed=0, threads=count_cores(), robot=robot)
