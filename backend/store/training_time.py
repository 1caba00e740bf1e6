"""How long runs were trained: the time of their attempts, without pauses and waits between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from typing import Any

from sqlalchemy import ColumnElement, Connection, extract, func, literal, select

from backend.store.tables import UtcDateTime, attempts, runs


@dataclass(frozen=True)
class TrainingTime:
    """Say how long a run was trained."""

    ended_s: float = 0.0
    """Time of the attempts that have ended [s]."""
    since: datetime | None = None
    """When the attempt began that runs; None if none does."""


NOT_TRAINED = TrainingTime()


def read_training_times(conn: Connection, run_ids: Sequence[str]) -> dict[str, TrainingTime]:
    """Return how long runs were trained, by run id; those without an attempt are left out."""
    columns = (attempts.c.run_id, attempts.c.started_at, attempts.c.ended_at)
    times: dict[str, TrainingTime] = {}
    for run_id, started_at, ended_at in conn.execute(select(*columns).where(attempts.c.run_id.in_(run_ids))):
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
    return select(seconds).where(attempts.c.run_id == runs.c.id).correlate(runs).scalar_subquery()
