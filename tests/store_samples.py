"""A store filled with plausible curves through its own functions: for tests at small size, for benchmarks at full."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.launches import LaunchOrder, launch
from backend.store.metrics import MetricPoint, append_metrics
from backend.store.outcomes import Succeeded
from backend.store.progress import Progress
from backend.store.queue import claim, finish
from backend.store.workers import register_worker
from sldr_core.records import Step

TEST_METRICS = ("test/success_rate", "test/best_success_rate", "test/final_distance")
LEASE_S = 3600.0


@dataclass(frozen=True)
class SampleSize:
    """Say how much a sample store holds."""

    tasks: Sequence[str] = ("FetchPush", "FetchSlide")
    methods: Sequence[str] = ("her", "ddpg")
    seeds: int = 3
    epochs: int = 10
    metrics: int = 4
    """Metrics of each point, those of the test among them."""


def fill_store(db: Database, size: SampleSize, seed: int = 0) -> list[str]:
    """Launch runs and let each log one point an epoch and succeed; return their ids."""
    rng = np.random.default_rng(seed)
    worker = register_worker(db, "here", 1, 1)
    ids: list[str] = []
    for task in size.tasks:
        for method in size.methods:
            ids += launch(db, LaunchOrder(task, "manipulation", method, range(size.seeds), "smoke"))
    while (held := claim(db, worker, LEASE_S)) is not None:
        _train(db, held, size, rng)
    return ids


def sample_curve(rng: np.random.Generator, epochs: int) -> np.ndarray:
    """Return a success rate that rises some time to some height `[epochs]`, of 380 episodes a test."""
    middle, speed, height = rng.uniform(0.2, 0.8), rng.uniform(5.0, 20.0), rng.uniform(0.5, 1.0)
    chance = height / (1.0 + np.exp(-speed * (np.linspace(0.0, 1.0, epochs) - middle)))
    return rng.binomial(380, chance) / 380


def _train(db: Database, held: Claim, size: SampleSize, rng: np.random.Generator) -> None:
    success = sample_curve(rng, size.epochs)
    append_metrics(db, held, list(_points(success, size.metrics, rng)))
    best = float(success.max())
    report = Progress(size.epochs, size.epochs, 100, 2, 4, 1.0, float(success[-1]), best, None, None, None)
    append_metrics(db, held, [], report)
    finish(db, held, Succeeded(float(success[-1])))


def _points(success: np.ndarray, metrics: int, rng: np.random.Generator) -> Iterator[MetricPoint]:
    pace = rng.uniform(0.9, 1.1)
    best = np.maximum.accumulate(success)
    for index, rate in enumerate(success.tolist()):
        epoch = index + 1
        values = {"test/success_rate": rate, "test/best_success_rate": float(best[index]), "test/final_distance": 0.1}
        values |= {f"critic/task/number_{k}": float(rng.normal()) for k in range(metrics - len(values))}
        step = Step(epoch * 50, epoch, epoch * 95_000, epoch * 1_900, epoch * 2_000, 60.0 * epoch * pace)
        yield MetricPoint(step, values)
