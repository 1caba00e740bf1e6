"""What a researcher would otherwise train with: Stable-Baselines3's SAC with hindsight, on gymnasium-robotics' task.

It takes hours, so each result is kept in a file with its curve, as far as it came, and can be taken from there; and
what it has learnt and seen is saved, so that another time it can be given more hours.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import torch
from bench_rows import seconds_until
from measured_page import describe_machine

KEPT = Path("docs/performance-peers.json")
"""Results by task and machine."""

SAVED = Path("build/peers")
"""A directory for each task, with the peer as its time was over."""

MODEL, REPLAY = "model.zip", "replay.pkl"

TESTED_EVERY = 5_000
"""Control steps between two tests."""

TEST_EPISODES = 50
THREADS = 2
SETTINGS: dict[str, Any] = {
    "batch_size": 256,
    "buffer_size": 1_000_000,
    "gamma": 0.95,
    "tau": 0.05,
    "learning_rate": 1e-3,
    "ent_coef": "auto",
    "learning_starts": 1_000,
    "train_freq": 1,
    "gradient_steps": 1,
    "policy_kwargs": {"net_arch": [256, 256, 256]},
    "replay_buffer_kwargs": {"n_sampled_goal": 4, "goal_selection_strategy": "future"},
}
"""Those of RL Baselines3 Zoo for Fetch tasks, with the paper's nets; one update for each control step."""


@dataclass
class PeerCurve:
    """How far a peer came: one entry a test."""

    task: str
    machine: str
    cap_s: float
    """Where it was stopped if it had not learnt by then [s]."""
    steps: list[int] = field(default_factory=list)
    """Control steps."""
    seconds: list[float] = field(default_factory=list)
    """Wall time, tests included [s]."""
    success: list[float] = field(default_factory=list)
    """Share of test episodes that end at the goal."""
    is_over: bool = False
    """It has learnt, or has had its time; else it was interrupted."""
    spent_s: float = 0.0
    """Wall time until it was saved [s]."""

    def seconds_to(self, rate: float) -> float:
        """Return when a test first reached a success rate [s]; infinity if none did."""
        return seconds_until(rate, self.seconds, self.success)

    def told(self, rate: float) -> str:
        """Say in words what it did."""
        if not self.steps:
            return f"the peer was not tested within {self.cap_s / 60:.0f} min"
        stood = f"{self.success[-1]:.0%} after {self.seconds[-1] / 60:.0f} min and {self.steps[-1]:,} steps"
        if self.seconds_to(rate) == float("inf"):
            return f"the peer stood at {stood}, so it takes longer yet"
        return f"the peer came to {stood}"


def train_peer(task: str, env_id: str, rate: float, cap_s: float, take_kept: bool) -> PeerCurve:
    """Train until a test reaches `rate`, or for `cap_s` [s].

    Args:
        task: what is to be learnt.
        env_id: the same task of gymnasium-robotics.
        rate: test success that counts.
        cap_s: how long it may take, all times together [s].
        take_kept: whether what was kept here from an earlier time is taken; if that was shorter, it goes on from there,
            or anew where it was not saved.
    """
    key = f"{task} on {describe_machine()}"
    curve = PeerCurve(task, describe_machine(), cap_s)
    kept = _read_kept().get(key)
    if take_kept and kept is not None and kept["is_over"]:
        earlier = PeerCurve(**kept)
        if earlier.seconds_to(rate) < float("inf") or earlier.cap_s >= cap_s:
            return earlier
        if (SAVED / task / REPLAY).exists():
            curve = replace(earlier, cap_s=cap_s, is_over=False)
    _train(env_id, rate, curve, lambda: _keep(key, curve))
    curve.is_over = True
    _keep(key, curve)
    return curve


def _train(env_id: str, rate: float, curve: PeerCurve, keep: Callable[[], None]) -> None:
    """Train from nothing, or from where it was saved if it has spent time before."""
    import gymnasium as gym
    import gymnasium_robotics
    from stable_baselines3 import SAC, HerReplayBuffer
    from stable_baselines3.common.callbacks import BaseCallback

    gym.register_envs(gymnasium_robotics)
    threads_before = torch.get_num_threads()
    torch.set_num_threads(THREADS)
    env, test_env = gym.make(env_id), gym.make(env_id)
    saved = SAVED / curve.task

    class Tests(BaseCallback):
        """Test now and then, and end the training once it has learnt or had its time."""

        def _on_step(self) -> bool:
            if self.num_timesteps % TESTED_EVERY == 0:
                curve.success.append(_test(self.model, test_env))
                curve.steps.append(self.num_timesteps)
                curve.seconds.append(time.perf_counter() - begun)
                keep()
                if curve.success[-1] >= rate:
                    return False
            return time.perf_counter() - begun < curve.cap_s

    try:
        if curve.spent_s:
            model = SAC.load(saved / MODEL, env, device="cpu")
            model.load_replay_buffer(saved / REPLAY)
        else:
            model = SAC("MultiInputPolicy", env, replay_buffer_class=HerReplayBuffer, seed=0, device="cpu", **SETTINGS)
        begun = time.perf_counter() - curve.spent_s
        model.learn(total_timesteps=10**9, callback=Tests(), reset_num_timesteps=not curve.spent_s)
        curve.spent_s = time.perf_counter() - begun
        model.save(saved / MODEL)
        model.save_replay_buffer(saved / REPLAY)
    finally:
        torch.set_num_threads(threads_before)
        env.close()
        test_env.close()


def _test(model: Any, env: Any) -> float:
    """Return in which share of episodes the object is at its goal at the last step."""
    ends: list[float] = []
    for episode in range(TEST_EPISODES):
        obs, _ = env.reset(seed=10_000 + episode)
        is_over, info = False, {"is_success": 0.0}
        while not is_over:
            action, _ = model.predict(obs, deterministic=True)
            obs, _, terminated, truncated, info = env.step(action)
            is_over = terminated or truncated
        ends.append(float(info["is_success"]))
    return float(np.mean(ends))


def _read_kept() -> dict[str, Any]:
    return json.loads(KEPT.read_text()) if KEPT.exists() else {}


def _keep(key: str, curve: PeerCurve) -> None:
    KEPT.parent.mkdir(parents=True, exist_ok=True)
    KEPT.write_text(json.dumps({**_read_kept(), key: asdict(curve)}, indent=1) + "\n")
