"""How much of everything there is: what a monitor watches."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime

from sqlalchemy import Select, func, select

from backend.store.database import Database, current_time
from backend.store.states import RunState
from backend.store.tables import run_events, runs
from backend.store.workers import select_workers


@dataclass(frozen=True)
class Census:
    """Count runs and workers."""

    runs: Mapping[RunState, int]
    """Runs in each state; deleted ones are left out."""
    workers_alive: int
    workers_draining: int
    """Those of them that take no further run."""
    slots: int
    """Runs that the living workers can train at once."""
    busy: int
    """Runs that they train."""
    queue_age_s: float
    """How long the longest waiting queued run has waited for a worker; 0 if none waits [s]."""


def take_census(db: Database) -> Census:
    """Count what is in the store."""
    not_deleted = runs.c.deleted_at.is_(None)
    with db.read() as conn:
        at = current_time(conn)
        states = select(runs.c.state, func.count()).where(not_deleted).group_by(runs.c.state)
        counts = {state: count for state, count in conn.execute(states)}
        oldest = conn.execute(_queued_since()).scalar_one()
        alive = [worker for worker in select_workers(conn) if worker.alive]
    return Census(
        runs={state: counts.get(state, 0) for state in RunState},
        workers_alive=len(alive),
        workers_draining=sum(worker.draining for worker in alive),
        slots=sum(worker.slots for worker in alive),
        busy=sum(worker.busy for worker in alive),
        queue_age_s=0.0 if oldest is None else max(0.0, (at - oldest).total_seconds()),
    )


def _queued_since() -> Select[datetime | None]:
    """Ask when the run that has waited longest for a worker came into the queue: its newest event brought it there."""
    newest = (
        select(func.max(run_events.c.at).label("at"))
        .join(runs, runs.c.id == run_events.c.run_id)
        .where(runs.c.state == RunState.QUEUED, runs.c.deleted_at.is_(None))
        .group_by(run_events.c.run_id)
        .subquery()
    )
    return select(func.min(newest.c.at))
