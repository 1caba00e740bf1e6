"""The attempts of a run: where each ran, how it ended, and where on the curve it began."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from sqlalchemy import func, select, update

from backend.store.claims import Claim, hold_fence
from backend.store.database import Database
from backend.store.errors import NotFound
from backend.store.states import Event
from backend.store.tables import attempts, metric_steps, runs, workers


@dataclass(frozen=True)
class AttemptRow:
    """Describe one attempt."""

    attempt: int
    fence: int
    worker_id: str
    host: str | None
    """The machine on which it ran, if it is known."""
    started_at: datetime
    ended_at: datetime | None
    outcome: Event | None
    """What ended it; None while it runs."""
    reason: str | None
    """Why it ended so, in one sentence."""
    first_cycle: int | None
    """The first cycle that it logged; from there on it supersedes earlier attempts. None if it logged nothing."""


def note_host(db: Database, claim: Claim, host: str) -> None:
    """Record on which machine an attempt runs.

    Raises:
        StaleFence: the attempt is over.
    """
    with db.write() as conn:
        hold_fence(conn, claim)
        this = (attempts.c.run_id == claim.run_id, attempts.c.attempt == claim.attempt)
        conn.execute(update(attempts).where(*this).values(host=host))


def list_attempts(db: Database, run_id: str) -> list[AttemptRow]:
    """Return the attempts of a run, oldest first; none before its first claim.

    Raises:
        NotFound: there is no such run.
    """
    first_cycles = (
        select(metric_steps.c.attempt, func.min(metric_steps.c.step).label("first_cycle"))
        .where(metric_steps.c.run_id == run_id)
        .group_by(metric_steps.c.attempt)
        .subquery()
    )
    query = (
        select(attempts, first_cycles.c.first_cycle, func.coalesce(attempts.c.host, workers.c.host).label("where"))
        .outerjoin(first_cycles, first_cycles.c.attempt == attempts.c.attempt)
        .outerjoin(workers, workers.c.id == attempts.c.worker_id)
        .where(attempts.c.run_id == run_id)
        .order_by(attempts.c.attempt)
    )
    with db.read() as conn:
        if conn.execute(select(runs.c.id).where(runs.c.id == run_id)).one_or_none() is None:
            raise NotFound("run", run_id)
        rows = conn.execute(query).mappings().all()
    return [
        AttemptRow(
            attempt=row["attempt"],
            fence=row["fence"],
            worker_id=row["worker_id"],
            host=row["where"],
            started_at=row["started_at"],
            ended_at=row["ended_at"],
            outcome=Event(row["outcome"]) if row["outcome"] else None,
            reason=row["reason"],
            first_cycle=row["first_cycle"],
        )
        for row in rows
    ]
