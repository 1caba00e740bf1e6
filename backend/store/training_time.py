"""How long runs were trained: the time of their attempts, without pauses and waits between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from typing import Any

from sqlalchemy import ColumnElement, Connection, extract, func, literal, or_, select

from backend.store.states import RunState
from backend.store.tables import UtcDateTime, attempts, runs

_COUNTS = or_(attempts.c.ended_at.is_not(None), runs.c.state == RunState.RUNNING)


@dataclass(frozen=True)
class TrainingTime:
    """Say how long a run was trained."""

    ended_s: float = 0.0
    """Time of the attempts that have ended [s]."""
    since: datetime | None = None
    """When the attempt began that runs; None if none does. An attempt without an end is one only while its run runs:
    earlier versions have left others."""


NOT_TRAINED = TrainingTime()


def read_training_times(conn: Connection, run_ids: Sequence[str]) -> dict[str, TrainingTime]:
    """Return how long runs were trained, by run id; those without an attempt are left out."""
    columns = (attempts.c.run_id, attempts.c.started_at, attempts.c.ended_at)
    query = select(*columns).join(runs, runs.c.id == attempts.c.run_id).where(attempts.c.run_id.in_(run_ids), _COUNTS)
    times: dict[str, TrainingTime] = {}
    for run_id, started_at, ended_at in conn.execute(query):
        before = times.get(run_id, NOT_TRAINED)
        if ended_at is None:
            times[run_id] = replace(before, since=started_at)
        else:
            ended_s = before.ended_s + (ended_at - started_at).total_seconds()
            times[run_id] = replace(before, ended_s=ended_s)
    return times


def training_seconds(now: datetime) -> ColumnElement[Any]:
    """Return how long the run of a query's row was trained until now, in SQL [s]; null without an attempt."""
    end = func.coalesce(attempts.c.ended_at, literal(now, UtcDateTime()))
    seconds = func.sum(extract("epoch", end) - extract("epoch", attempts.c.started_at))
    return select(seconds).where(attempts.c.run_id == runs.c.id, _COUNTS).correlate(runs).scalar_subquery()
