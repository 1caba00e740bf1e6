"""The orders in which runs can be listed, and where a page of such a list begins."""

from __future__ import annotations

from typing import Any, Literal

from sqlalchemy import ColumnElement, FromClause, and_, case, func, or_, select

from backend.store.states import RunState
from backend.store.tables import run_progress, runs

SortKey = Literal["launched", "task", "state", "success"]
"""What a list of runs can be sorted by; `success` is that of the newest test. Equal ones stand newest first."""

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


def sorted_by(sort: SortKey, descending: bool) -> tuple[ColumnElement[Any], ...]:
    """Return what a query of runs is ordered by; runs without a test stand last both ways."""
    value = _value(sort, descending, runs)
    return value.desc() if descending else value.asc(), runs.c.number.desc()


def comes_after(sort: SortKey, descending: bool, number: int) -> ColumnElement[bool]:
    """Return the condition that a run stands behind the one with `number`, as both are now."""
    last = runs.alias("last")
    limit = select(_value(sort, descending, last)).where(last.c.number == number).scalar_subquery()
    value = _value(sort, descending, runs)
    beyond = value < limit if descending else value > limit
    return or_(beyond, and_(value == limit, runs.c.number < number))


def _value(sort: SortKey, descending: bool, table: FromClause) -> ColumnElement[Any]:
    match sort:
        case "launched":
            return table.c.number
        case "task":
            return table.c.task
        case "state":
            return case(STATE_RANKS, value=table.c.state)
        case "success":
            newest = select(run_progress.c.success_rate).where(run_progress.c.run_id == table.c.id)
            return func.coalesce(newest.correlate(table).scalar_subquery(), -1.0 if descending else 2.0)
