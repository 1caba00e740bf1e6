"""How fast the runs table answers over very many runs: `python tests/store/bench_runs_table.py [--runs 1000]`.

It fills a store of each engine through the store's own functions, then measures what the page asks for.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path

TESTS = Path(__file__).parents[1]
sys.path[:0] = [str(TESTS), str(TESTS.parent)]

from many_runs import launch_many, train_many  # noqa: E402
from postgres_server import PostgresServer  # noqa: E402

from backend.store.database import Database, open_database  # noqa: E402
from backend.store.labels import change_tags  # noqa: E402
from backend.store.metric_columns import parse_column  # noqa: E402
from backend.store.run_filter import RunFilter  # noqa: E402
from backend.store.run_groups import group_runs  # noqa: E402
from backend.store.run_order import parse_order  # noqa: E402
from backend.store.runs import list_runs  # noqa: E402
from backend.store.settings import Settings, sqlite_url  # noqa: E402

REPEATS = 60
"""Measurements of each question."""
COLUMNS = (parse_column("test/success_rate:best"), parse_column("critic/task/loss:mean10"))


@contextmanager
def fresh_store(engine: str) -> Iterator[Database]:
    """Lend an empty store of an engine."""
    with tempfile.TemporaryDirectory() as directory:
        home = Path(directory)
        if engine == "sqlite":
            with closing(open_database(Settings(home=home, database_url=sqlite_url(home)))) as db:
                yield db
            return
        server = PostgresServer()
        server.start()
        try:
            address = server.url(server.create_database())
            with closing(open_database(Settings(home=home, database_url=address))) as db:
                yield db
        finally:
            server.stop()
            server.remove()


def questions(db: Database) -> dict[str, Callable[[], object]]:
    """Return what the page asks for, by what it shows."""
    everything, best = RunFilter(), parse_order("test/success_rate:best", True)
    mean = parse_order("critic/task/loss:mean10", False)
    narrow = RunFilter(tasks=["FetchPush"], tags=["good"], success_from=0.5, search="her")
    keys = ("task", "phase", "method", "preset", "settings")
    return {
        "first page, two metric columns": lambda: list_runs(db, everything, 50, columns=COLUMNS),
        "first page by best success": lambda: list_runs(db, everything, 50, order=best, columns=COLUMNS),
        "first page by a mean of last 10": lambda: list_runs(db, everything, 50, order=mean, columns=COLUMNS),
        "page in the middle": lambda: list_runs(db, everything, 50, columns=COLUMNS, offset=500),
        "narrowed by task, tag, success, word": lambda: list_runs(db, narrow, 50, columns=COLUMNS),
        "groups by all but the seed": lambda: group_runs(db, everything, keys, COLUMNS[0]),
    }


def measure(ask: Callable[[], object]) -> tuple[list[float], float]:
    """Return how long a question takes, sorted, and the processor time of one in this process [ms]."""
    ask()
    times: list[float] = []
    busy = time.process_time()
    for _ in range(REPEATS):
        start = time.perf_counter()
        ask()
        times.append(1000.0 * (time.perf_counter() - start))
    return sorted(times), 1000.0 * (time.process_time() - busy) / REPEATS


def main() -> None:
    """Fill and measure a store of each engine."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--epochs", type=int, default=50)
    parser.add_argument("--metrics", type=int, default=30)
    parser.add_argument("--engine", choices=("sqlite", "postgresql"), action="append")
    chosen = parser.parse_args()
    for engine in chosen.engine or ("sqlite", "postgresql"):
        with fresh_store(engine) as db:
            start = time.perf_counter()
            ids = launch_many(db, chosen.runs)
            train_many(db, chosen.runs, chosen.epochs, chosen.metrics)
            change_tags(db, ids[::3], ["good"], [])
            print(f"{engine}: {chosen.runs} runs filled in {time.perf_counter() - start:.0f} s")
            for name, ask in questions(db).items():
                times, busy = measure(ask)
                p95 = times[int(0.95 * len(times))]
                print(f"  {name:38} median {statistics.median(times):6.1f} ms   p95 {p95:6.1f} ms   CPU {busy:5.1f} ms")


if __name__ == "__main__":
    main()
