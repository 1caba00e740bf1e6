"""Questions of the runs and the compare page over very many runs, against the same questions to MLflow."""

from __future__ import annotations

import statistics
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import httpx
from bench_rows import REPETITIONS, Measured, Pairs, Target, row, seconds_of
from fastapi import FastAPI
from live_api import serving_client
from many_runs import METHODS, METRICS, TASKS, launch_many, metric_names, train_many
from mlflow_process import MlflowProcess, open_mlflow

from backend.api.app import create_app
from backend.comparison.curves import CurveView, compare_curves
from backend.comparison.memory import ComparisonMemory
from backend.comparison.records import Panel
from backend.store.compared_runs import RunChoice
from backend.store.database import Database, open_database
from backend.store.metric_columns import parse_column
from backend.store.run_filter import RunFilter
from backend.store.run_order import parse_order
from backend.store.runs import list_runs
from backend.store.settings import Settings, sqlite_url

RUNS, EPOCHS, LOGGED = 1000, 50, 30
"""Runs of each store, and the epochs and metrics of each run."""

SUCCESS = METRICS[0]
TASK = TASKS[0]
PAGE = 50
"""Runs of a page."""

LEAST_SUCCESS = 0.5
LONGEST_MS = 150.0


@dataclass(frozen=True)
class Question:
    """One thing that a page asks, in our words and in MLflow's; all answers tell how many runs they hold."""

    what: str
    look_up: Callable[[Database], int]
    """Ask our store, as MLflow's client asks its own."""
    path: str
    params: dict[str, Any]
    count: Callable[[Any], int]
    """Of our answer over HTTP."""
    command: str
    arguments: dict[str, Any]
    peer_count: Callable[[Any], int] = field(default=int)


_BEST = f"{SUCCESS}:last"
_BEST_FIRST = {"limit": PAGE, "sort": _BEST, "column": [_BEST, f"{METRICS[2]}:last"]}
_COLUMNS = [parse_column(text) for text in _BEST_FIRST["column"]]


def _look_up_page(db: Database, wanted: RunFilter) -> int:
    return len(list_runs(db, wanted, PAGE, order=parse_order(_BEST, descending=True), columns=_COLUMNS).rows)


def _look_up_curves(db: Database) -> int:
    return _members(compare_curves(db, ComparisonMemory(), RunChoice(tasks=(TASK,)), CurveView()).panels)


def _members(panels: Sequence[Panel]) -> int:
    return sum(len(curve.members) for panel in panels for curve in panel.curves)


QUESTIONS = (
    Question(
        "runs page, the best first",
        lambda db: _look_up_page(db, RunFilter()),
        "/api/runs",
        _BEST_FIRST,
        lambda answer: len(answer["runs"]),
        "first_page",
        {"limit": PAGE},
    ),
    Question(
        "runs page, one task's best above a success",
        lambda db: _look_up_page(db, RunFilter(tasks=(TASK,), success_from=LEAST_SUCCESS)),
        "/api/runs",
        {**_BEST_FIRST, "task": TASK, "success_from": LEAST_SUCCESS},
        lambda answer: len(answer["runs"]),
        "narrowed_page",
        {"limit": PAGE, "task": TASK, "least": LEAST_SUCCESS},
    ),
    Question(
        "compare page, one metric of all runs of a task by method",
        _look_up_curves,
        "/api/compare",
        {"task": TASK, "metric": SUCCESS},
        lambda answer: sum(len(curve["members"]) for panel in answer["panels"] for curve in panel["curves"]),
        "curves",
        {"task": TASK, "metric": SUCCESS},
        lambda told: sum(told.values()) // EPOCHS,
    ),
)


def measure_queries() -> Iterator[Measured]:
    """Fill both stores, then ask both in turns, each in its own process; and ask ours over HTTP as well."""
    with tempfile.TemporaryDirectory() as name, open_mlflow(Path(name)) as peer:
        settings = Settings(home=Path(name), database_url=sqlite_url(Path(name)))
        fill_store(settings, RUNS, LOGGED)
        kinds = {"tasks": list(TASKS), "methods": list(METHODS)}
        peer.ask("fill", runs=RUNS, epochs=EPOCHS, names=metric_names(LOGGED), **kinds)
        app = create_app(settings, Path(name) / "no-page")
        with serving_client(app) as client:
            for question in QUESTIONS:
                yield from _measure(question, app, client, peer)


def fill_store(settings: Settings, runs: int, metrics: int) -> None:
    """Put so many finished runs into a store, each with so many metrics."""
    with closing(open_database(settings)) as db:
        launch_many(db, runs)
        train_many(db, runs, EPOCHS, metrics)


def _measure(question: Question, app: FastAPI, client: httpx.Client, peer: MlflowProcess) -> Iterator[Measured]:
    db = app.state.service.database
    _check_same(question, db, client, peer)
    pairs, answers_ms = Pairs([], []), list[float]()
    for _ in range(REPETITIONS):
        pairs.ours.append(seconds_of(lambda: question.look_up(db)))
        pairs.theirs.append(peer.ask(question.command, **question.arguments).seconds)
        app.state.service = replace(app.state.service, memory=ComparisonMemory())
        answers_ms.append(1e3 * seconds_of(lambda: _ask(question, client)))
    ours, theirs = (1e3 * statistics.median(seconds) for seconds in (pairs.ours, pairs.theirs))
    detail = (
        f"{RUNS:,} runs of {EPOCHS} epochs and {LOGGED} metrics; each in its process, {ours:.0f} and {theirs:.0f} ms"
    )
    yield row(f"{question.what}, against MLflow", "x", pairs.speedups, Target("at least", 5.0), detail)
    yield row(f"{question.what}, over HTTP", "ms", answers_ms, Target("at most", LONGEST_MS), "nothing remembered")


def _check_same(question: Question, db: Database, client: httpx.Client, peer: MlflowProcess) -> None:
    """Ask all once, uncounted, and end if one tells of more than another."""
    ours, served = question.look_up(db), question.count(_ask(question, client))
    theirs = question.peer_count(peer.ask(question.command, **question.arguments).told)
    if not ours or not ours == served == theirs:
        told = f"{ours} from our store, {served} over HTTP and {theirs} from MLflow's store"
        raise SystemExit(f"'{question.what}' gave {told}.")


def _ask(question: Question, client: httpx.Client) -> Any:
    answer = client.get(question.path, params=question.params)
    answer.raise_for_status()
    return answer.json()
