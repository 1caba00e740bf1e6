"""Reading runs: one, several, pages of them, and their history."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from sqlalchemy import ColumnElement, Connection, FromClause, Text, cast, func, select

from backend.store.database import Database, current_time
from backend.store.errors import NotFound
from backend.store.labels import select_tags
from backend.store.metric_columns import MetricColumn, join_summaries
from backend.store.progress import PROGRESS, Progress, progress_of, with_progress
from backend.store.run_filter import RunFilter, conditions
from backend.store.run_order import RunOrder, comes_after, order_value, sorted_by
from backend.store.states import Event, RunState
from backend.store.tables import AnyRow, run_events, run_needs
from backend.store.tables import runs as run_table
from backend.store.training_time import NOT_TRAINED, TrainingTime, read_training_times
from sldr_core.errors import InvalidConfig

NEWEST_FIRST = RunOrder()


@dataclass(frozen=True)
class RunRow:
    """Describe one run."""

    id: str
    task: str
    phase: str
    method: str
    seed: int
    preset: str
    state: RunState
    reason: str | None
    """Why it waits or ended so, in one sentence."""
    needs: tuple[str, ...]
    """Ids of the locomotion runs that it takes its reward from."""
    unmet: tuple[str, ...]
    """Those of them that have not succeeded."""
    attempt: int
    """Claims so far."""
    progress: Progress | None
    success_rate: float | None
    """Test success of the finished training."""
    created_at: datetime
    started_at: datetime | None
    ended_at: datetime | None
    cancel_requested: bool
    """A person wants it to end, and its worker has not ended it yet."""
    pause_requested: bool
    """A person wants it to wait, and its worker has not paused it yet."""
    is_below_gate: bool
    """It is blocked by nothing but a locomotion model that missed the gate; a person can release it."""
    gate_waived: bool
    """A person has let it start below the gate."""
    needs_gpu: bool
    """Only a worker with a GPU takes it."""
    priority: int
    """Runs of a higher one start first."""
    worker_id: str | None
    """The worker that trains it."""
    not_before: datetime | None
    """When its next attempt may begin, if it waits after a failure."""
    deleted_at: datetime | None
    """When a person hid it."""
    config_json: str
    """What it trains, as JSON: lists of runs are asked for often, and their configs seldom."""
    config_hash: str
    settings_hash: str = ""
    """Equal for runs that differ in nothing but the seed."""
    tags: tuple[str, ...] = ()
    """What people call it, in the order of the alphabet."""
    notes: str = ""
    """What people wrote about it, as plain text."""
    training_time: TrainingTime = NOT_TRAINED
    """How long it was trained."""

    @property
    def config(self) -> dict[str, Any]:
        """What it trains."""
        return json.loads(self.config_json)


@dataclass(frozen=True)
class RunRows:
    """Hold one page of runs."""

    rows: list[RunRow]
    values: list[tuple[float | None, ...]]
    """For each run, the values of the columns asked for; None where it has not logged the metric."""
    next_cursor: str | None
    """Pass as `cursor` to get what comes next; None on the last page."""
    total: int
    """Runs that pass the filter, on all pages."""


@dataclass(frozen=True)
class EventRow:
    """Hold one line of a run's history."""

    at: datetime
    event: Event
    state: RunState
    """The state after it."""
    attempt: int
    detail: str | None


def get_run(db: Database, run_id: str) -> RunRow:
    """Return one run.

    Raises:
        NotFound: there is no such run.
    """
    with db.read() as conn:
        rows = run_rows(conn, [run_table.c.id == run_id])
    if not rows:
        raise NotFound("run", run_id)
    return rows[0]


def check_run(db: Database, run_id: str) -> None:
    """Make sure that there is such a run, which takes less than to read all of it.

    Raises:
        NotFound: there is none.
    """
    with db.read() as conn:
        if conn.execute(select(run_table.c.id).where(run_table.c.id == run_id)).one_or_none() is None:
            raise NotFound("run", run_id)


def get_runs(db: Database, run_ids: Sequence[str]) -> list[RunRow]:
    """Return several runs in the order asked for, leaving out those that do not exist."""
    with db.read() as conn:
        return _in_order(conn, run_ids)


def list_runs(
    db: Database,
    wanted: RunFilter,
    limit: int,
    cursor: str | None = None,
    order: RunOrder = NEWEST_FIRST,
    columns: Sequence[MetricColumn] = (),
    offset: int = 0,
) -> RunRows:
    """Return one page of runs, newest first unless another order is asked for; equals come newest first.

    Args:
        cursor: where the page before ended; good for going on while runs are added.
        columns: metrics of which each run's value is wanted too.
        offset: runs to leave out at the beginning; good for a jump into a long table.

    Raises:
        InvalidConfig: the cursor did not come from an earlier page.
    """
    with db.read() as conn:
        # First which runs, then what they are: a sort that carries whole rows takes twice as long.
        source, metrics = join_summaries(with_progress(), (*columns, *_sorting_columns(order)))
        value = order_value(order, metrics, current_time(conn))
        query = select(run_table.c.id, run_table.c.number, *(metrics[column] for column in columns))
        query = query.select_from(source).where(*conditions(wanted))
        page = query.order_by(*sorted_by(value, order.descending)).limit(limit + 1).offset(offset)
        if cursor is not None:
            page = page.where(_behind(conn, source, value, order, _number(cursor)))
        found = conn.execute(page).all()
        total = _count(conn, wanted)
        rows = _in_order(conn, [row.id for row in found[:limit]])
    values = [tuple(row[2:]) for row in found[:limit]]
    next_cursor = str(found[limit - 1].number) if len(found) > limit else None
    return RunRows(rows=rows, values=values, next_cursor=next_cursor, total=total)


def list_events(db: Database, run_id: str) -> list[EventRow]:
    """Return the history of a run, oldest first.

    Raises:
        NotFound: there is no such run.
    """
    with db.read() as conn:
        query = select(run_events).where(run_events.c.run_id == run_id).order_by(run_events.c.id)
        rows = conn.execute(query).all()
    if not rows:
        raise NotFound("run", run_id)
    return [
        EventRow(at=row.at, event=Event(row.event), state=RunState(row.state), attempt=row.attempt, detail=row.detail)
        for row in rows
    ]


def _number(cursor: str) -> int:
    if not cursor.isdecimal():
        raise InvalidConfig({"cursor": f"'{cursor}' is no cursor; pass on the next_cursor of the page before."})
    return int(cursor)


def _sorting_columns(order: RunOrder) -> tuple[MetricColumn, ...]:
    return (order.by,) if isinstance(order.by, MetricColumn) else ()


def _behind(
    conn: Connection, source: FromClause, value: ColumnElement[Any], order: RunOrder, number: int
) -> ColumnElement[bool]:
    """Return the condition that a run stands behind the one with this number, as both are now."""
    last = conn.execute(select(value).select_from(source).where(run_table.c.number == number)).scalar_one_or_none()
    return comes_after(value, order.descending, last, number)


def _count(conn: Connection, wanted: RunFilter) -> int:
    query = select(func.count()).select_from(with_progress()).where(*conditions(wanted))
    return conn.execute(query).scalar_one()


def run_rows(
    conn: Connection, which: Sequence[ColumnElement[bool]], order: Sequence[ColumnElement[Any]] = ()
) -> list[RunRow]:
    """Return the runs that fulfil conditions as records, with what other tables know of them."""
    rows = conn.execute(select(*_COLUMNS, *PROGRESS).select_from(with_progress()).where(*which).order_by(*order)).all()
    ids = [row.id for row in rows]
    needs: dict[str, list[AnyRow]] = {}
    query = (
        select(run_needs.c.run_id, run_needs.c.needs_run_id, run_table.c.state)
        .join(run_table, run_table.c.id == run_needs.c.needs_run_id)
        .where(run_needs.c.run_id.in_(ids))
        .order_by(run_needs.c.needs_run_id)
    )
    for edge in conn.execute(query):
        needs.setdefault(edge.run_id, []).append(edge)
    tags = select_tags(conn, ids)
    times = read_training_times(conn, ids)
    return [_run_row(row, needs.get(row.id, []), tags.get(row.id, ()), times.get(row.id, NOT_TRAINED)) for row in rows]


_COLUMNS = [
    cast(column, Text).label("config_json") if column is run_table.c.config else column for column in run_table.c
]


def _in_order(conn: Connection, run_ids: Sequence[str]) -> list[RunRow]:
    """Return runs in the order asked for, leaving out those that do not exist."""
    by_id = {row.id: row for row in run_rows(conn, [run_table.c.id.in_(run_ids)])}
    return [by_id[run_id] for run_id in run_ids if run_id in by_id]


def _run_row(row: AnyRow, needs: Sequence[AnyRow], tags: tuple[str, ...], training_time: TrainingTime) -> RunRow:
    unmet = tuple(edge.needs_run_id for edge in needs if edge.state != RunState.SUCCEEDED)
    return RunRow(
        id=row.id,
        task=row.task,
        phase=row.phase,
        method=row.method,
        seed=row.seed,
        preset=row.preset,
        state=RunState(row.state),
        reason=row.reason,
        needs=tuple(edge.needs_run_id for edge in needs),
        unmet=unmet,
        attempt=row.attempt,
        progress=progress_of(row),
        success_rate=row.success_rate,
        created_at=row.created_at,
        started_at=row.started_at,
        ended_at=row.ended_at,
        cancel_requested=row.cancel_requested,
        pause_requested=row.pause_requested,
        is_below_gate=row.state == RunState.BLOCKED and not unmet,
        gate_waived=row.gate_waived,
        needs_gpu=row.needs_gpu,
        priority=-row.rank,
        worker_id=row.worker_id,
        not_before=row.not_before,
        deleted_at=row.deleted_at,
        config_json=row.config_json,
        config_hash=row.config_hash,
        settings_hash=row.settings_hash or "",
        tags=tags,
        notes=row.notes or "",
        training_time=training_time,
    )
