"""Letting files go: first they are marked, in the transaction that takes their rows away; then their bytes go.

A process that dies in between leaves marks, and the next removal ends what it began. Bytes go only while the run's
row is held and has not moved on: an attempt that has begun meanwhile may have written a file of the same name.
"""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from sqlalchemy import Connection, delete, insert, select

from backend.store.database import Database, current_time
from backend.store.errors import FilesUnavailable
from backend.store.retention.plan import RetentionPlan, RunShare, find_protected, is_old_enough
from backend.store.retention.rule import Rule
from backend.store.settings import Settings
from backend.store.states import ENDED
from backend.store.storage import FileStorage
from backend.store.tables import SHARED, episodes, file_removals, media_jobs, run_files, runs

log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Removed:
    """Say what was removed."""

    runs: int
    """Runs that have lost something."""
    files: int
    size: int
    """Length of all of it [bytes]."""
    left: int
    """Files that are marked and still there: the shared place could not be reached. The next removal takes them."""


def apply_retention(db: Database, settings: Settings, plan: RetentionPlan) -> Removed:
    """Remove what a plan names, and what an earlier removal has left; runs that moved on since keep everything."""
    for share in plan.runs:
        _mark(db, plan.rule, share)
    return finish_removals(db, settings)


def finish_removals(db: Database, settings: Settings) -> Removed:
    """Remove the bytes of everything that is marked."""
    storage = FileStorage(settings)
    with db.read() as conn:
        run_ids = list(conn.execute(select(file_removals.c.run_id).distinct()).scalars())
    gone = [size for run_id in run_ids for size in _remove_of_run(db, settings, storage, run_id)]
    with db.read() as conn:
        left = len(conn.execute(select(file_removals.c.path)).all())
    return Removed(runs=len(run_ids), files=len(gone), size=sum(gone), left=left)


def _mark(db: Database, rule: Rule, share: RunShare) -> None:
    """Take away the rows of a run's files and note where their bytes lie; nothing if the run has moved on."""
    with db.write() as conn:
        row = conn.execute(select(runs).where(runs.c.id == share.run_id).with_for_update()).one()
        at = current_time(conn)
        if row.state not in ENDED or row.fence != share.fence or not is_old_enough(row.ended_at, rule, at):
            return
        if find_protected(conn, [row.id]):
            return
        names = [file.name for file in share.files if file.is_registered]
        conn.execute(delete(run_files).where(run_files.c.run_id == row.id, run_files.c.name.in_(names)))
        conn.execute(delete(episodes).where(episodes.c.run_id == row.id, episodes.c.file.in_(names)))
        # Whoever asks for a video again gets it drawn again.
        conn.execute(delete(media_jobs).where(media_jobs.c.run_id == row.id, media_jobs.c.file_name.in_(names)))
        there = set(conn.execute(select(file_removals.c.path).where(file_removals.c.run_id == row.id)).scalars())
        marks = [
            {"run_id": row.id, "path": file.place, "size": file.size, "fence": row.fence, "marked_at": at}
            for file in share.files
            if file.place not in there
        ]
        if marks:
            conn.execute(insert(file_removals), marks)


def _remove_of_run(db: Database, settings: Settings, storage: FileStorage, run_id: str) -> list[int]:
    """Remove what is marked of one run; return the length of each file that went [bytes]."""
    gone: list[int] = []
    with db.write() as conn:
        run = conn.execute(select(runs).where(runs.c.id == run_id).with_for_update()).one()
        here = _marks(conn, run_id, shared=False)
        for mark in here:
            is_same = run.state in ENDED and run.fence == mark.fence
            if is_same and _unlink(settings.home, mark.path):
                gone.append(mark.size)
        _unmark(conn, run_id, [mark.path for mark in here])
        far = _marks(conn, run_id, shared=True)
    for mark in far:
        if not _is_marked(db, run_id, mark.path):
            continue  # It has been drawn anew since, at the same path.
        try:
            storage.forget(mark.path.removeprefix(SHARED))
        except FilesUnavailable as err:
            log.warning("Left for the next time: %s", err)
            continue
        gone.append(mark.size)
        with db.write() as conn:
            _unmark(conn, run_id, [mark.path])
    return gone


def _marks(conn: Connection, run_id: str, shared: bool) -> list[_Mark]:
    query = select(file_removals).where(file_removals.c.run_id == run_id)
    marks = [_Mark(row.path, row.size, row.fence) for row in conn.execute(query)]
    return [mark for mark in marks if mark.path.startswith(SHARED) == shared]


def _is_marked(db: Database, run_id: str, path: str) -> bool:
    with db.read() as conn:
        marked = select(file_removals.c.size).where(file_removals.c.run_id == run_id, file_removals.c.path == path)
        return conn.execute(marked).first() is not None


def _unmark(conn: Connection, run_id: str, paths: Sequence[str]) -> None:
    conn.execute(delete(file_removals).where(file_removals.c.run_id == run_id, file_removals.c.path.in_(paths)))


def _unlink(home: Path, place: str) -> bool:
    """Remove a file below the data directory; return whether there was one."""
    path = (home / place).resolve()
    if not path.is_relative_to(home.resolve()) or not path.is_file():
        return False
    path.unlink(missing_ok=True)
    return True


@dataclass(frozen=True)
class _Mark:
    """One mark."""

    path: str
    size: int
    fence: int
