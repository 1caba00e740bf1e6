"""Questions of the runs and the compare page over very many runs, against the same questions to MLflow."""

from __future__ import annotations

import statistics
import tempfile
from collections.abc import Callable, Iterator
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
from backend.comparison.memory import ComparisonMemory
from backend.store.database import open_database
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
    """One thing that a page asks, in our words and in MLflow's."""

    what: str
    path: str
    params: dict[str, Any]
    command: str
    arguments: dict[str, Any]
    count: Callable[[Any], int]
    """What our answer holds: as many runs or points as MLflow's."""
    peer_count: Callable[[Any], int] = field(default=int)


_BEST_FIRST = {"limit": PAGE, "sort": f"{SUCCESS}:last", "column": [f"{SUCCESS}:last", f"{METRICS[2]}:last"]}

QUESTIONS = (
    Question(
        "runs page, the best first",
        "/api/runs",
        _BEST_FIRST,
        "first_page",
        {"limit": PAGE},
        lambda answer: len(answer["runs"]),
    ),
    Question(
        "runs page, one task's best above a success",
        "/api/runs",
        {**_BEST_FIRST, "task": TASK, "success_from": LEAST_SUCCESS},
        "narrowed_page",
        {"limit": PAGE, "task": TASK, "least": LEAST_SUCCESS},
        lambda answer: len(answer["runs"]),
    ),
    Question(
        "compare page, one metric of all runs of a task by method",
        "/api/compare",
        {"task": TASK, "metric": SUCCESS},
        "curves",
        {"task": TASK, "metric": SUCCESS},
        lambda answer: sum(len(curve["members"]) for panel in answer["panels"] for curve in panel["curves"]),
        lambda told: sum(told.values()) // EPOCHS,
    ),
)


def measure_queries() -> Iterator[Measured]:
    """Fill both stores, then ask both in turns; ours answers over HTTP, and remembers no comparison."""
    with tempfile.TemporaryDirectory() as name, open_mlflow(Path(name)) as peer:
        settings = Settings(home=Path(name), database_url=sqlite_url(Path(name)))
        _fill(settings)
        kinds = {"tasks": list(TASKS), "methods": list(METHODS)}
        peer.ask("fill", runs=RUNS, epochs=EPOCHS, names=metric_names(LOGGED), **kinds)
        app = create_app(settings, Path(name) / "no-page")
        with serving_client(app) as client:
            for question in QUESTIONS:
                yield from _measure(question, app, client, peer)


def _fill(settings: Settings) -> None:
    with closing(open_database(settings)) as db:
        launch_many(db, RUNS)
        train_many(db, RUNS, EPOCHS, LOGGED)


def _measure(question: Question, app: FastAPI, client: httpx.Client, peer: MlflowProcess) -> Iterator[Measured]:
    _check_same(question, client, peer)
    pairs = Pairs([], [])
    for _ in range(REPETITIONS):
        app.state.service = replace(app.state.service, memory=ComparisonMemory())
        pairs.ours.append(seconds_of(lambda: _ask(question, client)))
        pairs.theirs.append(peer.ask(question.command, **question.arguments).seconds)
    ours, theirs = (1e3 * statistics.median(seconds) for seconds in (pairs.ours, pairs.theirs))
    detail = f"{RUNS:,} runs of {EPOCHS} epochs and {LOGGED} metrics; {ours:.0f} against {theirs:.0f} ms"
    yield row(f"{question.what}, against MLflow", "x", pairs.speedups, Target("at least", 5.0), detail)
    answers_ms = [1e3 * seconds for seconds in pairs.ours]
    yield row(f"{question.what}, over HTTP", "ms", answers_ms, Target("at most", LONGEST_MS), "nothing remembered")


def _check_same(question: Question, client: httpx.Client, peer: MlflowProcess) -> None:
    """Ask both once, uncounted, and end if one tells of more than the other."""
    ours = question.count(_ask(question, client))
    theirs = question.peer_count(peer.ask(question.command, **question.arguments).told)
    if ours != theirs or not ours:
        raise SystemExit(f"'{question.what}' gave {ours} from our store and {theirs} from MLflow's.")


def _ask(question: Question, client: httpx.Client) -> Any:
    answer = client.get(question.path, params=question.params)
    answer.raise_for_status()
    return answer.json()
