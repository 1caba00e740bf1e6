"""Reading runs: one, several, pages of them, and their history."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from sqlalchemy import ColumnElement, Connection, String, cast, func, or_, select

from backend.store.database import Database
from backend.store.errors import NotFound
from backend.store.progress import Progress, select_progress
from backend.store.run_order import SortKey, comes_after, sorted_by
from backend.store.states import Event, RunState
from backend.store.tables import AnyRow, run_events, run_needs
from backend.store.tables import runs as run_table
from sldr_core.errors import InvalidConfig

SHORTEST_ID_WORD = 4
"""A shorter word is no beginning of an id: a search for seed 2 should not find every id with a 2."""


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
    config: dict[str, Any]
    config_hash: str


@dataclass(frozen=True)
class RunFilter:
    """Say which runs are wanted; None leaves a question open."""

    state: RunState | None = None
    task: str | None = None
    method: str | None = None
    phase: str | None = None
    search: str | None = None
    """Words that must all occur in task, method, phase, preset or state, or be the seed or the beginning of the id."""
    deleted: bool = False
    """Whether to return the runs that a person hid, instead of all others."""


@dataclass(frozen=True)
class RunRows:
    """Hold one page of runs."""

    rows: list[RunRow]
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
        rows = run_rows(conn, conn.execute(select(run_table).where(run_table.c.id == run_id)).all())
    if not rows:
        raise NotFound("run", run_id)
    return rows[0]


def get_runs(db: Database, run_ids: Sequence[str]) -> list[RunRow]:
    """Return several runs in the order asked for, leaving out those that do not exist."""
    with db.read() as conn:
        rows = run_rows(conn, conn.execute(select(run_table).where(run_table.c.id.in_(run_ids))).all())
    by_id = {row.id: row for row in rows}
    return [by_id[run_id] for run_id in run_ids if run_id in by_id]


def list_runs(
    db: Database,
    wanted: RunFilter,
    limit: int,
    cursor: str | None = None,
    sort: SortKey = "launched",
    descending: bool = True,
) -> RunRows:
    """Return one page of runs, newest first unless another order is asked for; equals come newest first.

    Raises:
        InvalidConfig: the cursor did not come from an earlier page.
    """
    conditions = _conditions(wanted)
    query = select(run_table).where(*conditions).order_by(*sorted_by(sort, descending)).limit(limit + 1)
    if cursor is not None:
        query = query.where(comes_after(sort, descending, _number(cursor)))
    with db.read() as conn:
        found = conn.execute(query).all()
        total = conn.execute(select(func.count()).select_from(run_table).where(*conditions)).scalar_one()
        rows = run_rows(conn, found[:limit])
    next_cursor = str(found[limit - 1].number) if len(found) > limit else None
    return RunRows(rows=rows, next_cursor=next_cursor, total=total)


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


def _conditions(wanted: RunFilter) -> list[ColumnElement[bool]]:
    exact = {"state": wanted.state, "task": wanted.task, "method": wanted.method, "phase": wanted.phase}
    conditions: list[ColumnElement[bool]] = [
        run_table.c[name] == value for name, value in exact.items() if value is not None
    ]
    hidden = run_table.c.deleted_at.is_not(None)
    conditions.append(hidden if wanted.deleted else ~hidden)
    conditions.extend(_mentions(word) for word in (wanted.search or "").split())
    return conditions


def _mentions(word: str) -> ColumnElement[bool]:
    columns = ("task", "method", "phase", "preset", "state")
    matches = [run_table.c[name].icontains(word, autoescape=True) for name in columns]
    if len(word) >= SHORTEST_ID_WORD:
        matches.append(run_table.c.id.istartswith(word, autoescape=True))
    return or_(*matches, cast(run_table.c.seed, String) == word)


def run_rows(conn: Connection, rows: Sequence[AnyRow]) -> list[RunRow]:
    """Return rows of the table as records, with what other tables know of them."""
    ids = [row.id for row in rows]
    progress = select_progress(conn, ids)
    needs: dict[str, list[AnyRow]] = {}
    query = (
        select(run_needs.c.run_id, run_needs.c.needs_run_id, run_table.c.state)
        .join(run_table, run_table.c.id == run_needs.c.needs_run_id)
        .where(run_needs.c.run_id.in_(ids))
        .order_by(run_needs.c.needs_run_id)
    )
    for edge in conn.execute(query):
        needs.setdefault(edge.run_id, []).append(edge)
    return [_run_row(row, needs.get(row.id, []), progress.get(row.id)) for row in rows]


def _run_row(row: AnyRow, needs: Sequence[AnyRow], progress: Progress | None) -> RunRow:
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
        progress=progress,
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
        config=row.config,
        config_hash=row.config_hash,
    )
