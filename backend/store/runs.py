"""Reading runs, and asking one to end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from sqlalchemy import ColumnElement, Connection, String, cast, func, or_, select

from backend.store.database import Database, current_time
from backend.store.dependents import settle_dependents
from backend.store.errors import NotFound
from backend.store.progress import Progress, select_progress
from backend.store.states import Event, RunState, change_state
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
    attempt: int
    """Claims so far."""
    progress: Progress | None
    success_rate: float | None
    """Test success of the finished training."""
    created_at: datetime
    started_at: datetime | None
    ended_at: datetime | None
    cancel_requested: bool
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


@dataclass(frozen=True)
class RunRows:
    """Hold one page of runs, newest first."""

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
        rows = _run_rows(conn, conn.execute(select(run_table).where(run_table.c.id == run_id)).all())
    if not rows:
        raise NotFound("run", run_id)
    return rows[0]


def get_runs(db: Database, run_ids: Sequence[str]) -> list[RunRow]:
    """Return several runs in the order asked for, leaving out those that do not exist."""
    with db.read() as conn:
        rows = _run_rows(conn, conn.execute(select(run_table).where(run_table.c.id.in_(run_ids))).all())
    by_id = {row.id: row for row in rows}
    return [by_id[run_id] for run_id in run_ids if run_id in by_id]


def list_runs(db: Database, wanted: RunFilter, limit: int, cursor: str | None = None) -> RunRows:
    """Return one page of runs, newest first.

    Raises:
        InvalidConfig: the cursor did not come from an earlier page.
    """
    conditions = _conditions(wanted)
    query = select(run_table).where(*conditions).order_by(run_table.c.number.desc()).limit(limit + 1)
    if cursor is not None:
        query = query.where(run_table.c.number < _number(cursor))
    with db.read() as conn:
        found = conn.execute(query).all()
        total = conn.execute(select(func.count()).select_from(run_table).where(*conditions)).scalar_one()
        rows = _run_rows(conn, found[:limit])
    next_cursor = str(found[limit - 1].number) if len(found) > limit else None
    return RunRows(rows=rows, next_cursor=next_cursor, total=total)


def request_cancel(db: Database, run_id: str) -> None:
    """End a run: at once if no worker has it, else as soon as its worker has heard.

    Raises:
        NotFound: there is no such run.
        WrongState: it has ended already.
    """
    with db.write() as conn:
        at = current_time(conn)
        query = select(run_table).where(run_table.c.id == run_id).with_for_update()
        run = conn.execute(query).one_or_none()
        if run is None:
            raise NotFound("run", run_id)
        if run.state != RunState.RUNNING:
            change_state(conn, run_id, Event.CANCELLED, at=at, reason="Cancelled before it began or while it waited.")
            settle_dependents(conn, run_id, at)
        elif not run.cancel_requested:
            change_state(conn, run_id, Event.CANCEL_REQUESTED, at=at, changes={"cancel_requested": True})


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
    conditions.extend(_mentions(word) for word in (wanted.search or "").split())
    return conditions


def _mentions(word: str) -> ColumnElement[bool]:
    columns = ("task", "method", "phase", "preset", "state")
    matches = [run_table.c[name].icontains(word, autoescape=True) for name in columns]
    if len(word) >= SHORTEST_ID_WORD:
        matches.append(run_table.c.id.istartswith(word, autoescape=True))
    return or_(*matches, cast(run_table.c.seed, String) == word)


def _run_rows(conn: Connection, rows: Sequence[AnyRow]) -> list[RunRow]:
    ids = [row.id for row in rows]
    progress = select_progress(conn, ids)
    needs: dict[str, list[str]] = {}
    query = select(run_needs).where(run_needs.c.run_id.in_(ids)).order_by(run_needs.c.needs_run_id)
    for edge in conn.execute(query):
        needs.setdefault(edge.run_id, []).append(edge.needs_run_id)
    return [_run_row(row, tuple(needs.get(row.id, ())), progress.get(row.id)) for row in rows]


def _run_row(row: AnyRow, needs: tuple[str, ...], progress: Progress | None) -> RunRow:
    return RunRow(
        id=row.id,
        task=row.task,
        phase=row.phase,
        method=row.method,
        seed=row.seed,
        preset=row.preset,
        state=RunState(row.state),
        reason=row.reason,
        needs=needs,
        attempt=row.attempt,
        progress=progress,
        success_rate=row.success_rate,
        created_at=row.created_at,
        started_at=row.started_at,
        ended_at=row.ended_at,
        cancel_requested=row.cancel_requested,
        config=row.config,
        config_hash=row.config_hash,
    )
