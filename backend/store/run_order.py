"""The orders in which runs can be listed, and where a page of such a list begins."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from sqlalchemy import ColumnElement, FromClause, and_, case, func, or_, select

from backend.store.states import RunState
from backend.store.tables import run_progress, runs


class SortKey(StrEnum):
    """What runs can be sorted by; equal ones stand newest first."""

    LAUNCHED = "launched"
    """The time of the launch."""
    STATE = "state"
    """What needs the eye first: running, then waiting, then failed, then ended well."""
    SUCCESS = "success"
    """Success of the newest test; runs without one stand last."""
    TASK = "task"
    """The task's name."""


@dataclass(frozen=True)
class RunOrder:
    """Say how a list of runs is sorted."""

    key: SortKey
    descending: bool


NEWEST_FIRST = RunOrder(SortKey.LAUNCHED, descending=True)

STATE_RANKS = {
    RunState.RUNNING: 0,
    RunState.QUEUED: 1,
    RunState.PAUSED: 2,
    RunState.BLOCKED: 3,
    RunState.FAILED: 4,
    RunState.SUCCEEDED: 5,
    RunState.CANCELLED: 6,
}


def sorted_by(order: RunOrder) -> tuple[ColumnElement[Any], ...]:
    """Return what a query of runs is ordered by."""
    value = _value(order, runs)
    return value.desc() if order.descending else value.asc(), runs.c.number.desc()


def comes_after(order: RunOrder, number: int) -> ColumnElement[bool]:
    """Return the condition that a run stands behind the one with `number`, as both are now."""
    last = runs.alias("last")
    limit = select(_value(order, last)).where(last.c.number == number).scalar_subquery()
    value = _value(order, runs)
    beyond = value < limit if order.descending else value > limit
    return or_(beyond, and_(value == limit, runs.c.number < number))


def _value(order: RunOrder, table: FromClause) -> ColumnElement[Any]:
    match order.key:
        case SortKey.LAUNCHED:
            return table.c.number
        case SortKey.TASK:
            return table.c.task
        case SortKey.STATE:
            return case(STATE_RANKS, value=table.c.state)
        case SortKey.SUCCESS:
            newest = select(run_progress.c.success_rate).where(run_progress.c.run_id == table.c.id)
            missing = -1.0 if order.descending else 2.0
            return func.coalesce(newest.correlate(table).scalar_subquery(), missing)
