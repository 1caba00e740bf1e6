"""The orders in which runs can be listed, and where a page of such a list begins."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Literal, get_args

from sqlalchemy import ColumnElement, and_, case, or_

from backend.store.metric_columns import MetricColumn, parse_column
from backend.store.states import RunState
from backend.store.tables import run_progress, runs
from backend.store.training_time import training_seconds
from sldr_core.errors import InvalidConfig

SortKey = Literal[
    "launched",
    "task",
    "phase",
    "method",
    "seed",
    "preset",
    "state",
    "progress",
    "success",
    "best",
    "speed",
    "left",
    "duration",
]
"""What runs have a column for whatever they log; `success` is that of the newest test, `best` that of the best."""

STATE_RANKS = {
    RunState.RUNNING: 0,
    RunState.QUEUED: 1,
    RunState.PAUSED: 2,
    RunState.BLOCKED: 3,
    RunState.FAILED: 4,
    RunState.SUCCEEDED: 5,
    RunState.CANCELLED: 6,
}
"""By state, what moves comes first, then what waits, then what has ended."""


@dataclass(frozen=True)
class RunOrder:
    """Say what runs are sorted by. Equal ones stand newest first, those without a value last both ways."""

    by: SortKey | MetricColumn = "launched"
    descending: bool = True


def parse_order(sort: str, descending: bool) -> RunOrder:
    """Read an order by `launched` and the like, or by a column of a metric.

    Raises:
        InvalidConfig: there is no such column.
    """
    for key in get_args(SortKey):
        if key == sort:
            return RunOrder(key, descending)
    if ":" not in sort:
        names = ", ".join(get_args(SortKey))
        raise InvalidConfig({"sort": f"'{sort}' is no column; there are {names}, and metrics such as a/b:last."})
    return RunOrder(parse_column(sort, "sort"), descending)


def order_value(
    order: RunOrder, metrics: Mapping[MetricColumn, ColumnElement[float]], now: datetime
) -> ColumnElement[Any]:
    """Return what is compared, of a run with its progress and the summary of the metric beside it."""
    if isinstance(order.by, MetricColumn):
        return metrics[order.by]
    is_running = runs.c.state == RunState.RUNNING
    values: dict[SortKey, ColumnElement[Any]] = {
        "launched": runs.c.number,
        "state": case(STATE_RANKS, value=runs.c.state),
        "progress": run_progress.c.fraction,
        "success": run_progress.c.success_rate,
        "best": run_progress.c.best_success_rate,
        "speed": case((is_running, run_progress.c.env_steps_per_s)),
        "left": case((is_running, run_progress.c.seconds_left)),
        "duration": training_seconds(now),
    }
    return values[order.by] if order.by in values else runs.c[order.by]


def sorted_by(value: ColumnElement[Any], descending: bool) -> tuple[ColumnElement[Any], ...]:
    """Return what a query of runs is ordered by."""
    is_missing = case((value.is_(None), 1), else_=0)
    return is_missing.asc(), value.desc() if descending else value.asc(), runs.c.number.desc()


def comes_after(value: ColumnElement[Any], descending: bool, last: object, number: int) -> ColumnElement[bool]:
    """Return the condition that a run stands behind the one with this number, whose value is `last`."""
    if last is None:
        return and_(value.is_(None), runs.c.number < number)
    beyond = value < last if descending else value > last
    return or_(beyond, value.is_(None), and_(value == last, runs.c.number < number))
