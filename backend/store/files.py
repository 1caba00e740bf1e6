"""The stored files of runs: rows that say where the bytes lie, with size and checksum."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from sqlalchemy import delete, insert, select

from backend.store.claims import Claim, hold_fence
from backend.store.database import Database, current_time
from backend.store.errors import NotFound
from backend.store.tables import run_files

REPLAY_FILE = "replay.bin"
"""What a checkpoint needs beside it in the run's directory; it is never registered itself."""
REPLAY_LIST = "replay-blocks.json"
"""The list of the replay file's blocks, where machines share files."""
LOG_FILE = "log.txt"
"""What a run's processes have said; registered where machines share files."""


@dataclass(frozen=True)
class FileRow:
    """Describe one stored file."""

    run_id: str
    name: str
    kind: str
    """What it is for, such as `policy` or `checkpoint`."""
    path: str
    """Where it lies, below the data directory or the place that machines share."""
    size: int
    """Length [bytes]."""
    sha256: str
    attempt: int
    """The attempt that wrote it."""
    created_at: datetime


def register_file(db: Database, claim: Claim, name: str, kind: str, path: str, size: int, sha256: str) -> str | None:
    """Record a file that an attempt has written; one of the same name is replaced.

    Returns:
        The path that the name stood for before, if it was another.

    Raises:
        StaleFence: the attempt is over.
    """
    with db.write() as conn:
        hold_fence(conn, claim)
        this = (run_files.c.run_id == claim.run_id, run_files.c.name == name)
        before = conn.execute(select(run_files.c.path).where(*this)).scalar_one_or_none()
        conn.execute(delete(run_files).where(*this))
        conn.execute(
            insert(run_files).values(
                run_id=claim.run_id,
                name=name,
                kind=kind,
                path=path,
                size=size,
                sha256=sha256,
                attempt=claim.attempt,
                created_at=current_time(conn),
            )
        )
    return None if before == path else before


def find_file(db: Database, run_id: str, name: str) -> FileRow:
    """Return a file of a run.

    Raises:
        NotFound: the run has no such file.
    """
    with db.read() as conn:
        query = select(run_files).where(run_files.c.run_id == run_id, run_files.c.name == name)
        row = conn.execute(query).mappings().one_or_none()
    if row is None:
        raise NotFound(f"file of run {run_id} called", name)
    return FileRow(**row)


def list_files(db: Database, run_id: str) -> list[FileRow]:
    """Return the files of a run, by name."""
    with db.read() as conn:
        query = select(run_files).where(run_files.c.run_id == run_id).order_by(run_files.c.name)
        return [FileRow(**row) for row in conn.execute(query).mappings()]
