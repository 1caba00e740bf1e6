"""How far a run is: the newest report of its trainer."""

from __future__ import annotations

from dataclasses import dataclass, fields

from sqlalchemy import Connection, FromClause, bindparam, insert, select, update

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


def store_progress(conn: Connection, run_id: str, progress: Progress) -> None:
    """Replace the progress of a run that the caller holds."""
    values = vars(progress)
    if conn.execute(_UPDATE, {"of_run": run_id, **values}).rowcount == 0:
        conn.execute(insert(run_progress).values(run_id=run_id, **values))


def find_progress(db: Database, run_id: str) -> Progress | None:
    """Return the run's newest progress, or None before its first report."""
    with db.read() as conn:
        row = conn.execute(select(*PROGRESS).where(run_progress.c.run_id == run_id)).one_or_none()
    return None if row is None else progress_of(row)


def with_progress() -> FromClause:
    """Return the runs, each with its progress beside it if it has reported any."""
    return runs.outerjoin(run_progress, run_progress.c.run_id == runs.c.id)


def progress_of(row: AnyRow) -> Progress | None:
    """Return the progress in a row that has the columns `PROGRESS`; None of a run that has reported none."""
    values = row[-len(FIELDS) :]
    return None if values[0] is None else Progress(*values)


PROGRESS = [run_progress.c[name].label(f"progress_{name}") for name in FIELDS]
"""The last columns of a query of runs `with_progress`."""


# Made once: it is run for every cycle of every training.
_UPDATE = (
    update(run_progress)
    .where(run_progress.c.run_id == bindparam("of_run"))
    .values({name: bindparam(name) for name in FIELDS})
)
