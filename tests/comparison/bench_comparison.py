"""Measure comparisons over 1,040 runs of 50 epochs and 30 metrics: `python tests/comparison/bench_comparison.py`.

The store is made once, in about a minute on two idle cores, and kept for the next time.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))

from store_samples import SampleSize, fill_store

from backend.comparison.best import compare_best
from backend.comparison.curves import CurveView, compare_curves
from backend.comparison.memory import ComparisonMemory
from backend.store.compared_runs import RunChoice
from backend.store.database import Database, open_database
from backend.store.settings import Settings, sqlite_url
from sldr_core.config import METHODS, TASKS

SIZE = SampleSize(
    tasks=tuple(TASKS),
    # Those without a locomotion run, which would only wait.
    methods=tuple(spec.name for spec in METHODS.values() if not spec.needs_locomotion),
    seeds=16,
    epochs=50,
    metrics=30,
)
REPEATS = 100


def main() -> None:
    """Print one row a question: the first time, and median and 95th percentile of the times after."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--home", type=Path, default=Path("build/bench-comparison"), help="where the store is kept")
    db = _open(parser.parse_args().home)
    print(f"{'question':24} {'first':>9} {'median':>9} {'p95':>9}   [ms], of {REPEATS}")
    for name, ask in QUESTIONS.items():
        memory = ComparisonMemory()
        first, *rest = [_time(lambda memory=memory, ask=ask: ask(db, memory)) for _ in range(REPEATS + 1)]
        print(f"{name:24} {first:9.1f} {np.median(rest):9.1f} {np.percentile(rest, 95):9.1f}")
    db.close()


def _anew(db: Database, memory: ComparisonMemory) -> object:
    """Ask for another level each time, so that no answer is remembered; curves are."""
    _anew_counter[0] += 1
    return compare_curves(db, memory, RunChoice(), CurveView(level=0.9 + 1e-4 * _anew_counter[0]))


_anew_counter = [0]

QUESTIONS: dict[str, Callable[[Database, ComparisonMemory], object]] = {
    "curves, same question": lambda db, memory: compare_curves(db, memory, RunChoice(), CurveView()),
    "curves, new question": _anew,
    "curves of one task": lambda db, memory: compare_curves(db, memory, RunChoice(tasks=["FetchPush"]), CurveView()),
    "best, same question": lambda db, memory: compare_best(db, memory, RunChoice(), CurveView()),
}


def _open(home: Path) -> Database:
    is_new = not home.exists()
    home.mkdir(parents=True, exist_ok=True)
    db = open_database(Settings(home=home.absolute(), database_url=sqlite_url(home.absolute())))
    if is_new:
        fill_store(db, SIZE)
    return db


def _time(ask: Callable[[], object]) -> float:
    started = time.perf_counter()
    ask()
    return 1e3 * (time.perf_counter() - started)


if __name__ == "__main__":
    main()
