"""Writing metrics: values per second into our store, as a worker sends them, against MLflow's batches."""

from __future__ import annotations

import math
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import replace
from pathlib import Path

from bench_rows import REPETITIONS, Measured, Pairs, Target, row
from many_runs import launch_many, metric_names
from mlflow_process import MlflowProcess, open_mlflow

from backend.store.claims import Claim
from backend.store.database import Database, open_database
from backend.store.metrics import MetricPoint, append_metrics
from backend.store.progress import Progress
from backend.store.queue import claim
from backend.store.settings import Settings, sqlite_url
from sldr_core.records import Step

METRICS = 30
"""Values of a batch: what a cycle of her-sldr logs. A worker sends what there is every half second, mostly a cycle."""

BATCHES = 200
"""Batches of a turn."""

WARM_UP = 10
"""Batches before the first turn."""


def measure_metrics() -> Iterator[Measured]:
    """Write the same batches into both stores, in turns."""
    with tempfile.TemporaryDirectory() as name, open_mlflow(Path(name)) as peer, closing(_open(Path(name))) as db:
        launch_many(db, 1)
        held = claim(db, "bench", 3600.0)
        assert held is not None
        yield _as_row(*_take_turns(_Writer(db, held).write, peer))


def _take_turns(write: Callable[[int], None], peer: MlflowProcess) -> tuple[Pairs, Pairs]:
    """Return the seconds of each turn, and what each took of a processor [s]."""
    names, wall, cpu = metric_names(METRICS), Pairs([], []), Pairs([], [])
    write(WARM_UP)
    peer.ask("log_batches", batches=WARM_UP, names=names)
    for _ in range(REPETITIONS):
        begun, used = time.perf_counter(), time.process_time()
        write(BATCHES)
        wall.ours.append(time.perf_counter() - begun)
        cpu.ours.append(time.process_time() - used)
        theirs = peer.ask("log_batches", batches=BATCHES, names=names)
        wall.theirs.append(theirs.seconds)
        cpu.theirs.append(theirs.cpu_s)
    return wall, cpu


def _as_row(wall: Pairs, cpu: Pairs) -> Measured:
    ours, theirs = (BATCHES * METRICS / statistics.median(seconds) for seconds in (wall.ours, wall.theirs))
    busy = [1e3 * statistics.median(seconds) / BATCHES for seconds in (cpu.ours, cpu.theirs)]
    return row(
        f"writing metrics, batches of {METRICS}, against MLflow's `log_batch`, both to SQLite",
        "x",
        wall.speedups,
        Target("at least", 5.0),
        f"{ours:,.0f} against {theirs:,.0f} values/s; {busy[0]:.1f} against {busy[1]:.1f} ms of a processor a batch",
    )


class _Writer:
    """Write batches as a worker's `MetricWriter` does: a point, and how far the run is."""

    def __init__(self, db: Database, held: Claim) -> None:
        self._db = db
        self._held = held
        self._names = metric_names(METRICS)
        self._cycle = 0

    def write(self, batches: int) -> None:
        for _ in range(batches):
            self._cycle += 1
            step = Step(self._cycle, 1, 1900 * self._cycle, 38 * self._cycle, 80 * self._cycle, 1.0 * self._cycle)
            point = MetricPoint(step, dict.fromkeys(self._names, math.sin(self._cycle)))
            progress = replace(_BEGUN, env_steps=step.env_steps, updates=step.updates)
            append_metrics(self._db, self._held, [point], progress)


_BEGUN = Progress(1, 20, 0, 0, 0, 0.1, 0.5, 0.5, 1000.0, 20.0, 60.0)


def _open(home: Path) -> Database:
    return open_database(Settings(home=home, database_url=sqlite_url(home)))
