"""The workers known to the store, and whether they are alive."""

from __future__ import annotations

import uuid
from dataclasses import dataclass
from datetime import datetime, timedelta

from sqlalchemy import func, insert, select, update

from backend.store.database import Database, current_time
from backend.store.errors import NotFound
from backend.store.states import RunState
from backend.store.tables import runs, workers

ALIVE_S = 30.0
"""A worker counts as alive this long after its last sign of life [s]."""
SHOWN_S = 3600.0
"""A worker that fell silent is still listed for this long [s]."""


@dataclass(frozen=True)
class WorkerRow:
    """Describe one worker process."""

    id: str
    host: str
    pid: int
    slots: int
    """Runs it can train at once."""
    busy: int
    """Runs it trains now."""
    beat_at: datetime
    """Its last sign of life."""
    alive: bool


def register_worker(db: Database, host: str, pid: int, slots: int) -> str:
    """Make a worker known and return its id."""
    worker_id = uuid.uuid4().hex[:12]
    with db.write() as conn:
        at = current_time(conn)
        values = {"id": worker_id, "host": host, "pid": pid, "slots": slots, "started_at": at, "beat_at": at}
        conn.execute(insert(workers).values(values))
    return worker_id


def beat(db: Database, worker_id: str) -> None:
    """Show that a worker is alive.

    Raises:
        NotFound: the worker was never registered.
    """
    with db.write() as conn:
        change = update(workers).where(workers.c.id == worker_id).values(beat_at=current_time(conn))
        if conn.execute(change).rowcount == 0:
            raise NotFound("worker", worker_id)


def retire(db: Database, worker_id: str) -> None:
    """Take a worker that ends in good order off the list."""
    with db.write() as conn:
        conn.execute(update(workers).where(workers.c.id == worker_id).values(retired_at=current_time(conn)))


def list_workers(db: Database) -> list[WorkerRow]:
    """Return the workers that are alive or fell silent lately, longest serving first."""
    busy = (
        select(runs.c.worker_id, func.count().label("busy"))
        .where(runs.c.state == RunState.RUNNING)
        .group_by(runs.c.worker_id)
        .subquery()
    )
    with db.read() as conn:
        at = current_time(conn)
        query = (
            select(workers, func.coalesce(busy.c.busy, 0).label("busy"))
            .outerjoin(busy, busy.c.worker_id == workers.c.id)
            .where(workers.c.retired_at.is_(None), workers.c.beat_at > at - timedelta(seconds=SHOWN_S))
            .order_by(workers.c.started_at)
        )
        rows = conn.execute(query).all()
    dead_before = at - timedelta(seconds=ALIVE_S)
    return [
        WorkerRow(
            id=row.id,
            host=row.host,
            pid=row.pid,
            slots=row.slots,
            busy=row.busy,
            beat_at=row.beat_at,
            alive=row.beat_at > dead_before,
        )
        for row in rows
    ]
