"""How far a run is: the newest report of its trainer."""

from __future__ import annotations

from dataclasses import asdict, dataclass, fields

from sqlalchemy import Connection, FromClause, insert, select, update

from backend.store.claims import Claim, hold_fence
from backend.store.database import Database
from backend.store.tables import AnyRow, run_progress, runs


@dataclass(frozen=True)
class Progress:
    """Say how far a run is."""

    epoch: int
    """Epochs begun."""
    epochs: int
    """Epochs of the whole training."""
    env_steps: int
    """Control steps of training episodes."""
    episodes: int
    """Training episodes."""
    updates: int
    """Gradient updates."""
    fraction: float
    """Share of the whole training done, 0 to 1."""
    success_rate: float | None
    """Success of the newest test."""
    best_success_rate: float | None
    """Success of the best test."""
    env_steps_per_s: float | None
    """Speed of collecting [1/s]."""
    updates_per_s: float | None
    """Speed of learning [1/s]."""
    seconds_left: float | None
    """Estimate of what is left [s]."""


FIELDS = tuple(field.name for field in fields(Progress))


def report_progress(db: Database, claim: Claim, progress: Progress) -> None:
    """Replace the run's progress.

    Raises:
        StaleFence: the attempt is over.
    """
    values = asdict(progress)
    with db.write() as conn:
        hold_fence(conn, claim)
        change = update(run_progress).where(run_progress.c.run_id == claim.run_id).values(values)
        if conn.execute(change).rowcount == 0:
            conn.execute(insert(run_progress).values(run_id=claim.run_id, **values))


def find_progress(db: Database, run_id: str) -> Progress | None:
    """Return the run's newest progress, or None before its first report."""
    with db.read() as conn:
        return select_progress(conn, [run_id]).get(run_id)


def select_progress(conn: Connection, run_ids: list[str]) -> dict[str, Progress]:
    """Return the progress of those of the runs that have reported any."""
    rows = conn.execute(select(run_progress).where(run_progress.c.run_id.in_(run_ids)))
    return {row.run_id: _progress(row) for row in rows}


def with_progress() -> FromClause:
    """Return the runs, each with its progress beside it if it has reported any."""
    return runs.outerjoin(run_progress, run_progress.c.run_id == runs.c.id)


def _progress(row: AnyRow) -> Progress:
    return Progress(**{name: getattr(row, name) for name in FIELDS})
