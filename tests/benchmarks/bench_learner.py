"""The learner: an update against Stable-Baselines3's, a plain matrix product and another method's update."""

from __future__ import annotations

import statistics
import tempfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import torch
from bench_models import paper_training
from bench_rows import REPETITIONS, Measured, Stopwatch, Target, row, seconds_of, time_pairs

from sldr_core.nets.transitions import Transitions
from sldr_core.replay import Sampler
from sldr_core.training.build import Parts
from sldr_core.training.cycle import collect_random, learn
from sldr_core.zoo.index import SHIPPED

BATCH = 4864
UPDATES = 10
"""Updates that are timed together."""

EPISODES = 20
"""Cycles of random episodes that fill the replay before sampling is timed."""


def measure_learner() -> Iterator[Measured]:
    """Time updates of the paper's sizes."""
    with tempfile.TemporaryDirectory() as name:
        root = Path(name)
        yield from _against_stable_baselines(root)
        yield _against_matrix_product(root)
        yield _against_her(root)
        for task in ("FetchPush", "HandBlockFull"):
            yield _share_of_sampling(root, task)


def _against_stable_baselines(root: Path) -> Iterator[Measured]:
    peer = _peer()
    for precision, target in (("float32", 1.2), ("bfloat16", 3.0)):
        parts = learning_training(root, "FetchPush", "her", precision)
        pairs = time_pairs(lambda parts=parts: learn_cycle(parts), lambda: peer.train(UPDATES, BATCH))
        yield row(
            f"one HER update at {BATCH}, {precision}, against Stable-Baselines3's DDPG",
            "x",
            pairs.speedups,
            Target("at least", target),
            f"{_ms(pairs.ours)} against {_ms(pairs.theirs)} an update, each with sampling",
        )


def _against_matrix_product(root: Path) -> Measured:
    """Compare floating point operations a second with those of one product of the hidden layers' size."""
    parts = learning_training(root, "FetchPush", "her", "float32")
    batch, rewards = _one_batch(parts)
    left, right = torch.randn(BATCH, 256), torch.randn(256, 256)
    product_flops = 2.0 * BATCH * 256 * 256
    products = 40

    def multiply() -> None:
        for _ in range(products):
            torch.mm(left, right)

    pairs = time_pairs(lambda: parts.agent.update(batch, rewards), multiply)
    ours = [_update_flops(parts) / seconds for seconds in pairs.ours]
    theirs = [products * product_flops / seconds for seconds in pairs.theirs]
    return row(
        "learner's floating point operations, against a plain product of its sizes, float32",
        "x",
        [one / other for one, other in zip(ours, theirs, strict=True)],
        Target("at least", 0.75),
        f"{statistics.median(ours) / 1e9:.0f} against {statistics.median(theirs) / 1e9:.0f} GFLOP/s",
    )


def _against_her(root: Path) -> Measured:
    """Pay the robot by the model that a launch takes, which is smaller than one of the paper's size."""
    her, large = (
        learning_training(root, "FetchPush", "her", "float32"),
        learning_training(root, "FetchPush", "her-sldr", "float32"),
    )
    shipped = learning_training(root, "FetchPush", "her-sldr", "float32", SHIPPED / "FetchPush.pt")
    pairs, of_large = (
        time_pairs(lambda sldr=sldr: learn_cycle(sldr), lambda: learn_cycle(her)) for sldr in (shipped, large)
    )
    return row(
        "a her-sldr update against a her update",
        "x",
        pairs.costs,
        Target("at most", 1.7),
        f"{_ms(pairs.ours)} against {_ms(pairs.theirs)} an update, with the locomotion model that comes with the "
        f"product; {statistics.median(of_large.costs):.2f} x with one of the paper's size",
    )


def _share_of_sampling(root: Path, task: str) -> Measured:
    parts = learning_training(root, task, "her", "float32")
    for _ in range(EPISODES):
        collect_random(parts, _carry_on)
    watch = Stopwatch()
    timed = replace(parts, sampler=_TimedSampler(parts.sampler, watch))
    learn_cycle(timed)
    shares: list[float] = []
    for _ in range(REPETITIONS):
        watch.total_s = 0.0
        whole_s = seconds_of(lambda: learn_cycle(timed))
        shares.append(100.0 * watch.total_s / whole_s)
    return row(
        f"{task}: sampling and relabelling a batch of {BATCH}, of the update",
        "%",
        shares,
        Target("at most", 5.0),
        f"replay of {parts.buffer.written:,} episodes",
    )


class _TimedSampler:
    """Draw as another sampler does, and add up how long that takes."""

    def __init__(self, sampler: Sampler, watch: Stopwatch) -> None:
        self.rng = sampler.rng
        self.sample = watch.around(sampler.sample)


def learning_training(
    root: Path, task: str, method: str, precision: str = "float32", model: Path | None = None, batch: int = BATCH
) -> Parts:
    """Return a training whose cycle has few updates, and whose replay takes little room.

    Args:
        root: of its files.
        task: what the robot learns.
        method: by which it learns.
        precision: `float32` or `bfloat16`.
        model: the locomotion model; one of the paper's size that has learnt nothing if None.
        batch: transitions of an update.
    """
    settings = {
        "compute": {"precision": precision},
        "replay": {"capacity": 100_000},
        "loop": {"updates_per_cycle": UPDATES, "batch_size": batch},
    }
    return paper_training(root, task, method, settings, model)


def learn_cycle(parts: Parts) -> None:
    """Make the updates of one cycle."""
    learn(parts, 0, _carry_on)


def _one_batch(parts: Parts) -> tuple[Transitions, torch.Tensor]:
    sample = parts.sampler.sample(BATCH, 0)
    names = ("obs", "next_obs", "goal", "action", "reward")
    batch = Transitions(**{name: torch.from_numpy(getattr(sample, name)) for name in names}, extra={})
    return batch, torch.stack([stream.reward(batch) for stream in parts.streams])


def _update_flops(parts: Parts) -> float:
    """Count the products of an update: a pass forward is 2 flops a weight and sample, backward twice that.

    Targets take the actor and the critics forward. Critics are trained (forward, backward). The actor is trained
    through the critics: both forward, the critics back to their input, the actor back.
    """
    actor = sum(weight.numel() for weight in parts.agent.actor.weights)
    critics = sum(weight.numel() for weight in parts.agent.critics.weights)
    weights = (actor + critics) + 3 * critics + (actor + critics) + critics + 2 * actor
    return 2.0 * BATCH * weights


def _peer() -> Any:
    """Return Stable-Baselines3's DDPG on the same features, nets and batch, its replay full of noise."""
    import gymnasium as gym
    from stable_baselines3 import DDPG

    class Noise(gym.Env[np.ndarray, np.ndarray]):
        """Stand in for an environment of FetchPush's sizes."""

        observation_space = gym.spaces.Box(-1.0, 1.0, (28,), np.float32)
        action_space = gym.spaces.Box(-1.0, 1.0, (4,), np.float32)

    model = DDPG("MlpPolicy", Noise(), buffer_size=10_000, batch_size=BATCH, policy_kwargs={"net_arch": [256] * 3})
    model.set_logger(_quiet())
    rng = np.random.default_rng(0)
    for _ in range(10_000):
        obs, next_obs = rng.normal(size=(2, 1, 28)).astype(np.float32)
        action = rng.uniform(-1, 1, (1, 4)).astype(np.float32)
        assert model.replay_buffer is not None
        model.replay_buffer.add(obs, next_obs, action, np.array([-1.0]), np.array([0.0]), [{}])
    return model


def _quiet() -> Any:
    from stable_baselines3.common.logger import Logger

    return Logger(folder=None, output_formats=[])


def _ms(seconds: list[float]) -> str:
    return f"{1000 * statistics.median(seconds) / UPDATES:.0f} ms"


def _carry_on() -> None:
    """Ask for nothing."""
