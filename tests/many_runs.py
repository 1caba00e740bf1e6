"""Very many runs in a store, put there by the store's own functions, as a year of work would leave them."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.launches import LaunchOrder, launch
from backend.store.metrics import MetricPoint, append_metrics
from backend.store.outcomes import Succeeded
from backend.store.progress import Progress
from backend.store.queue import claim, finish
from sldr_core.records import Step

TASKS = ("FetchPush", "FetchSlide", "FetchPickAndPlace", "HandBlockRotate")
METHODS = ("ddpg", "her", "cher", "her-dense", "her-rnd")
"""Those that need no locomotion run."""
METRICS = ("test/success_rate", "train/success_rate", "critic/task/loss", "actor/loss", "test/final_distance")
"""The first of the metrics; further ones are called `extra/0` and so on."""
CYCLES = 50
"""Between two epochs [cycles]."""


def metric_names(count: int) -> list[str]:
    """Return the names of so many metrics."""
    return [*METRICS, *(f"extra/{i}" for i in range(count))][:count]


def launch_many(db: Database, count: int) -> list[str]:
    """Launch manipulation runs, so many, over tasks and methods, with seeds of their own; return their ids."""
    kinds = [(task, method) for task in TASKS for method in METHODS]
    ids: list[str] = []
    for index, (task, method) in enumerate(kinds):
        seeds = range(len(range(index, count, len(kinds))))
        if seeds:
            ids += launch(db, LaunchOrder(task, "manipulation", method, seeds, "smoke"))
    return ids


def train_many(db: Database, count: int, epochs: int, metrics: int) -> list[Claim]:
    """Claim the next runs, log a curve of each and let them succeed; the curves rise at different speeds."""
    drawn = random.Random(0)
    names = metric_names(metrics)
    claims: list[Claim] = []
    for _ in range(count):
        held = claim(db, "many-runs", 3600.0)
        assert held is not None
        log_curve(db, held, names, epochs, drawn)
        claims.append(held)
    return claims


def log_curve(db: Database, held: Claim, names: Sequence[str], epochs: int, drawn: random.Random) -> None:
    """Log a whole training in one batch, with its progress, and let it succeed."""
    speed = drawn.uniform(0.02, 0.3)
    points = [
        MetricPoint(_step(epoch), {name: _value(name, epoch, speed, drawn) for name in names})
        for epoch in range(1, epochs + 1)
    ]
    successes = [point.values[METRICS[0]] for point in points]
    last = points[-1].step
    append_metrics(
        db,
        held,
        points,
        Progress(
            epoch=epochs,
            epochs=epochs,
            env_steps=last.env_steps,
            episodes=last.episodes,
            updates=last.updates,
            fraction=1.0,
            success_rate=successes[-1],
            best_success_rate=max(successes),
            env_steps_per_s=drawn.uniform(500.0, 3000.0),
            updates_per_s=drawn.uniform(50.0, 200.0),
            seconds_left=0.0,
        ),
    )
    finish(db, held, Succeeded(successes[-1]))


def _step(epoch: int) -> Step:
    cycle = CYCLES * epoch
    return Step(cycle, epoch, 2_000 * cycle, 40 * cycle, 40 * cycle, 0.5 * cycle)


def _value(name: str, epoch: int, speed: float, drawn: random.Random) -> float:
    rising = 1.0 - math.exp(-speed * epoch)
    noisy = min(1.0, max(0.0, rising + drawn.gauss(0.0, 0.03)))
    return 1.0 - noisy if name.endswith(("loss", "distance")) else noisy
