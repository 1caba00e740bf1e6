"""The workers known to the store, and whether they are alive."""

from __future__ import annotations

import uuid
from dataclasses import asdict, dataclass
from datetime import datetime, timedelta

from sqlalchemy import Connection, insert, select, update

from backend.store.database import Database, current_time
from backend.store.errors import NotFound
from backend.store.states import RunState
from backend.store.tables import runs, workers

ALIVE_S = 30.0
"""A worker counts as alive this long after its last sign of life [s]."""
SHOWN_S = 3600.0
"""A worker that fell silent is still listed for this long [s]."""


@dataclass(frozen=True)
class Machine:
    """Say what a worker has to train with."""

    cores: int = 0
    """Cores that it may use; 0 if nobody knows."""
    processor: str | None = None
    """Model that these are of, if it says so."""
    gpu: str | None = None
    """Name of its GPU, if it has one."""
    memory_total: int = 0
    """Its memory [bytes]; 0 if nobody knows."""
    executor: str = "local"
    """What runs its attempts: `local` processes, or `ray`."""


@dataclass(frozen=True)
class WorkerRow:
    """Describe one worker process."""

    id: str
    host: str
    pid: int
    executor: str
    """What runs its attempts: `local` processes, or `ray`."""
    slots: int
    """Runs it can train at once."""
    busy: int
    """Runs it trains now."""
    running: tuple[str, ...]
    """Their ids."""
    cores: int
    """Cores that it may use; 0 if nobody knows."""
    processor: str | None
    """Model that these are of, if it says so."""
    gpu: str | None
    """Name of its GPU, if it has one."""
    memory_total: int
    """Memory of its machine [bytes]; 0 if nobody knows."""
    memory_used: int
    """How much of that was in use at its last sign of life [bytes]."""
    draining: bool
    """It takes no further run and keeps those that it has."""
    beat_at: datetime
    """Its last sign of life."""
    alive: bool


def register_worker(db: Database, host: str, pid: int, slots: int, machine: Machine | None = None) -> str:
    """Make a worker known and return its id."""
    worker_id = uuid.uuid4().hex[:12]
    with db.write() as conn:
        at = current_time(conn)
        values = {"id": worker_id, "host": host, "pid": pid, "slots": slots}
        conn.execute(insert(workers).values(**values, **asdict(machine or Machine()), started_at=at, beat_at=at))
    return worker_id


def beat(db: Database, worker_id: str, memory_used: int = 0) -> None:
    """Show that a worker is alive.

    Args:
        memory_used: memory in use on its machine [bytes].

    Raises:
        NotFound: the worker was never registered.
    """
    with db.write() as conn:
        values = {"beat_at": current_time(conn), "memory_used": memory_used}
        change = update(workers).where(workers.c.id == worker_id).values(values)
        if conn.execute(change).rowcount == 0:
            raise NotFound("worker", worker_id)


def set_draining(db: Database, worker_id: str, draining: bool) -> None:
    """Let a worker take no further run, or let it take runs again; it keeps what it has.

    Raises:
        NotFound: there is no such worker, or it has ended.
    """
    with db.write() as conn:
        there = (workers.c.id == worker_id, workers.c.retired_at.is_(None))
        if conn.execute(update(workers).where(*there).values(draining=draining)).rowcount == 0:
            raise NotFound("worker", worker_id)


def retire(db: Database, worker_id: str) -> None:
    """Take a worker that ends in good order off the list."""
    with db.write() as conn:
        conn.execute(update(workers).where(workers.c.id == worker_id).values(retired_at=current_time(conn)))


def list_workers(db: Database) -> list[WorkerRow]:
    """Return the workers that are alive or fell silent lately, longest serving first."""
    with db.read() as conn:
        return select_workers(conn)


def select_workers(conn: Connection) -> list[WorkerRow]:
    """Return the workers that are alive or fell silent lately, longest serving first."""
    at = current_time(conn)
    lately = (workers.c.retired_at.is_(None), workers.c.beat_at > at - timedelta(seconds=SHOWN_S))
    rows = conn.execute(select(workers).where(*lately).order_by(workers.c.started_at)).all()
    running: dict[str, list[str]] = {}
    query = select(runs.c.id, runs.c.worker_id).where(runs.c.state == RunState.RUNNING).order_by(runs.c.number)
    for run in conn.execute(query):
        running.setdefault(run.worker_id, []).append(run.id)
    dead_before = at - timedelta(seconds=ALIVE_S)
    return [
        WorkerRow(
            id=row.id,
            host=row.host,
            pid=row.pid,
            executor=row.executor,
            slots=row.slots,
            busy=len(running.get(row.id, ())),
            running=tuple(running.get(row.id, ())),
            cores=row.cores,
            processor=row.processor,
            gpu=row.gpu,
            memory_total=row.memory_total,
            memory_used=row.memory_used,
            draining=row.draining,
            beat_at=row.beat_at,
            alive=row.beat_at > dead_before,
        )
        for row in rows
    ]
