"""Runs with plausible curves, put into a store as workers would put them there, without any training."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Mapping

import numpy as np

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.metrics import MetricPoint, append_metrics
from backend.store.outcomes import Failed, Succeeded
from backend.store.progress import Progress
from backend.store.queue import claim, finish
from backend.store.workers import Machine, register_worker
from sldr_core.records import Step

MIDWAY = {"her-sldr": 0.3, "her-rnd": 0.42, "her": 0.45, "her-dense": 0.6, "ddpg-sldr": 0.7, "cher": 0.75, "ddpg": 0.9}
"""Share of the training after which each method is half as good as it gets."""
CEILING = {
    "her-sldr": 0.97,
    "her-rnd": 0.86,
    "her": 0.84,
    "her-dense": 0.55,
    "ddpg-sldr": 0.3,
    "cher": 0.2,
    "ddpg": 0.06,
}
"""Test success that each method comes near."""
EPISODES_PER_EPOCH = 380
UPDATES_PER_EPOCH = 800
EPOCH_S = 24.0
"""A plausible duration of an epoch [s]."""

WHOLE = 1.0
"""The share of a training that is over at its end."""


def play_out(
    db: Database,
    epochs: int,
    share_of: Callable[[Claim], float] = lambda _claim: WHOLE,
    most: int | None = None,
    host: str = "lab-1",
) -> list[str]:
    """Claim queued runs and log curves for them; return the ids of those claimed.

    Args:
        db: the store.
        epochs: tests in each whole training.
        share_of: how much of its training a run has behind it; below 1 it stays running, below 0 it fails there.
        most: the most runs to claim; all if None.
        host: name of the machine of the worker that claims them.
    """
    worker = register_worker(db, host, 4242, 64, Machine(cores=64, gpu="H100", memory_total=128 * 10**9))
    played: list[str] = []
    while most is None or len(played) < most:
        claimed = claim(db, worker, lease_s=24 * 3600.0)
        if claimed is None:
            break
        _play(db, claimed, epochs, share_of(claimed))
        played.append(claimed.run_id)
    return played


def success_curve(task: str, method: str, seed: int, phase: str, epochs: int) -> np.ndarray:
    """Return the test success after each epoch, `[epochs]`: an S whose place and height follow from the arguments."""
    rng = np.random.default_rng(zlib.crc32(f"{task} {method} {seed} {phase}".encode()))
    hardness = zlib.crc32(task.encode()) % 7 / 14
    is_object = phase == "locomotion"
    midway = 0.15 if is_object else MIDWAY.get(method, 0.5) * (0.7 + hardness) + rng.normal(0, 0.06)
    ceiling = 1.0 if is_object else CEILING.get(method, 0.5) * (1 - 0.3 * hardness) * rng.uniform(0.88, 1.0)
    done = np.arange(1, epochs + 1) / epochs
    curve = ceiling / (1 + np.exp(-14 * (done - midway)))
    # An object's curve is smooth enough to end above the gate, so that the robot's runs may start.
    return np.clip(curve + rng.normal(0, 0.01 if is_object else 0.025, epochs), 0, 1)


def _play(db: Database, claimed: Claim, epochs: int, share: float) -> None:
    config = claimed.config
    curve = success_curve(config.task, config.method, config.seed, config.phase, epochs)
    logged = max(1, round(abs(share) * epochs))
    pace = 1.7 if config.method.endswith("sldr") else 1.0
    points = [_point(config.loop.cycles_per_epoch, epoch, curve, pace) for epoch in range(1, logged + 1)]
    append_metrics(db, claimed, points)
    _report(db, claimed, points[-1], curve[:logged], epochs)
    if share >= WHOLE:
        finish(db, claimed, Succeeded(success_rate=float(curve[-1])))
    elif share < 0:
        finish(db, claimed, Failed("The loss of the critic is not a number at cycle 57.", retry=False))


def _point(cycles_per_epoch: int, epoch: int, curve: np.ndarray, pace: float) -> MetricPoint:
    step = Step(
        cycle=epoch * cycles_per_epoch,
        epoch=epoch,
        env_steps=epoch * EPISODES_PER_EPOCH * 50,
        episodes=epoch * EPISODES_PER_EPOCH,
        updates=epoch * UPDATES_PER_EPOCH,
        wall_seconds=epoch * EPOCH_S * pace,
    )
    return MetricPoint(step, _values(float(curve[epoch - 1]), epoch))


def _values(success: float, epoch: int) -> Mapping[str, float]:
    return {
        "test/success_rate": success,
        "train/success_rate": success * 0.85,
        "critic/task/loss": 0.4 * (1.05 - success) / epoch**0.5,
        "stream/task/mean": success - 1,
        "speed/env_steps_per_s": 790.0 + 10 * (epoch % 5),
    }


def _report(db: Database, claimed: Claim, point: MetricPoint, curve: np.ndarray, epochs: int) -> None:
    step = point.step
    left = epochs - step.epoch
    progress = Progress(
        epoch=step.epoch,
        epochs=epochs,
        env_steps=step.env_steps,
        episodes=step.episodes,
        updates=step.updates,
        fraction=step.epoch / epochs,
        success_rate=float(curve[-1]),
        best_success_rate=float(curve.max()),
        env_steps_per_s=790.0,
        updates_per_s=33.0,
        seconds_left=left * EPOCH_S,
    )
    append_metrics(db, claimed, [], progress)
