"""Fifty people who watch while two runs train: how soon they are answered, and what the trainings lose by it.

Windows alone and watched take turns within the same two trainings, which the product's own queue and worker train.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import psutil
import signed_in
from bench_rows import Measured, Target, row
from bench_service import free_port
from many_runs import launch_many, train_many
from polling_pages import OpenPage, Polled, browsers, compare_page, queue_page, run_page, runs_table
from served_product import WHOLE, serving

from backend.store.database import Database, open_database
from backend.store.launches import LaunchOrder, launch
from backend.store.metrics import read_metrics
from backend.store.settings import Settings, sqlite_url

CLIENTS = {"runs": 20, "run": 16, "queue": 8, "compare": 6}
"""How many people have which page open."""
EARLIER_RUNS = 200
"""Runs that have ended and fill the table."""
WINDOW_S = 60.0
"""A window, alone or watched [s]."""
PAIRS = 5
"""Windows alone, each with a watched one after it."""
SETTLED_CYCLES = 5
"""Cycles of both trainings before the first window."""
PATIENCE_S = 300.0
"""Both trainings are at work by then [s]."""

STEADY = {"loop": {"cycles_per_epoch": 1_000_000, "epochs": 1}, "compute": {"threads": 1}}
"""A training on one core that never comes to a test: every cycle is the same work."""


@dataclass(frozen=True)
class Watched:
    """What a watched window gave, beside the one alone before it."""

    slower: float
    """What the trainings lost [%]."""
    polled: Polled
    server_s: float
    """What the API took of a core [s]."""


class TrainedRun:
    """Follow how far a run is, by what it has stored."""

    def __init__(self, database: Database, run_id: str) -> None:
        self._database = database
        self._run_id = run_id
        self._cursor = 0
        self.updates, self.wall_s, self.cycles = 0, 0.0, 0

    def advance(self) -> tuple[int, float]:
        """Return the updates since the last call and the seconds of training that they took."""
        before = (self.updates, self.wall_s)
        new = read_metrics(self._database, self._run_id, self._cursor, names=())
        if new.updates:
            self._cursor = new.cursor
            self.updates, self.wall_s, self.cycles = new.updates[-1], new.wall_seconds[-1], new.step[-1]
        return self.updates - before[0], self.wall_s - before[1]


def measure_clients(pairs: int = PAIRS, window_s: float = WINDOW_S) -> Iterator[Measured]:
    """Train two runs, and look at them with many browsers every other window."""
    with ExitStack() as stack:
        home = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        settings = Settings(home=home, database_url=sqlite_url(home))
        database = stack.enter_context(closing(open_database(settings)))
        launch_many(database, EARLIER_RUNS)
        train_many(database, EARLIER_RUNS, epochs=20, metrics=5)
        run_ids = launch(database, LaunchOrder("FetchPush", "manipulation", "her", (1000, 1001), "quick", STEADY))
        port = free_port()
        options = ("--workers", "2")
        address = stack.enter_context(serving(home, port, WHOLE, needs=("workers_alive",), options=options))
        trained = [TrainedRun(database, run_id) for run_id in run_ids]
        _wait_until_settled(trained)
        line = stack.enter_context(browsers(port, _open_pages(address, run_ids)))
        api = _api_process(port)
        watched: list[Watched] = []
        for _ in range(pairs):
            alone = _rate(trained, lambda: time.sleep(window_s))
            cpu_s = sum(api.cpu_times()[:2])
            line.send(window_s)
            answers: list[Polled] = []
            beside = _rate(trained, lambda into=answers: into.append(line.recv()))
            slower = 100.0 * (1.0 - beside / alone)
            watched.append(Watched(slower, answers[0], sum(api.cpu_times()[:2]) - cpu_s))
    yield from _rows(watched, window_s)


def _rows(watched: list[Watched], window_s: float) -> Iterator[Measured]:
    people = sum(CLIENTS.values())
    p95 = [1000.0 * float(np.quantile(window.polled.seconds, 0.95)) for window in watched]
    asked = [len(window.polled.seconds) for window in watched]
    wrong = sum(
        count for window in watched for status, count in window.polled.statuses.items() if status not in (200, 304)
    )
    known = sum(window.polled.statuses.get(304, 0) for window in watched) / sum(asked)
    yield row(
        f"95 % of answers to {people} open pages while two runs train",
        "ms",
        p95,
        Target("at most", 200.0),
        f"{statistics.median(asked) / window_s:.0f} requests a second, {known:.0%} of them unchanged, {wrong} refused",
    )
    each = [1000.0 * window.server_s / count for window, count in zip(watched, asked, strict=True)]
    browsers_s = statistics.median(window.polled.cpu_s for window in watched)
    yield row(
        f"two trainings slowed by {people} open pages",
        "%",
        [window.slower for window in watched],
        Target("at most", 5.0),
        f"updates a second; the API takes {statistics.median(each):.1f} ms of a core a request, "
        f"the browsers {100 * browsers_s / window_s:.1f} % of a core",
    )


def _open_pages(address: str, run_ids: list[str]) -> list[OpenPage]:
    """Return every open page, each signed in by itself."""
    asks = [
        *[runs_table()] * CLIENTS["runs"],
        *[run_page(run_ids[number % len(run_ids)]) for number in range(CLIENTS["run"])],
        *[queue_page()] * CLIENTS["queue"],
        *[compare_page()] * CLIENTS["compare"],
    ]
    return [OpenPage(page, "; ".join(f"{c['name']}={c['value']}" for c in signed_in.cookies())) for page in asks]


def _wait_until_settled(trained: list[TrainedRun]) -> None:
    give_up_at = time.monotonic() + PATIENCE_S
    while min(run.cycles for run in trained) < SETTLED_CYCLES:
        if time.monotonic() > give_up_at:
            raise SystemExit("The two trainings did not begin.")
        time.sleep(0.5)
        for run in trained:
            run.advance()


def _rate(trained: list[TrainedRun], pass_time: Callable[[], object]) -> float:
    """Return the updates a second of all trainings together over a window, from its first whole cycle to its last."""
    for run in trained:
        run.advance()
    pass_time()
    gained = [run.advance() for run in trained]
    if not all(seconds for _, seconds in gained):
        raise SystemExit("A training told of no cycle in a window; take longer windows.")
    return sum(updates / seconds for updates, seconds in gained)


def _api_process(port: int) -> psutil.Process:
    """Return the process that answers at a port."""
    children = psutil.Process().children(recursive=True)
    heard = ((process, at) for process in children for at in process.net_connections("tcp"))
    return next(process for process, at in heard if at.laddr.port == port and not at.raddr)
