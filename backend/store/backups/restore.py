"""Restoring a backup: into an empty data directory and store, of whichever engine, or in the place of what is there.

Everything is looked at first. Then the files are put where the settings say, and at last the rows, in one
transaction: until that is done the store is what it was.
"""

from __future__ import annotations

import shutil
from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from sqlalchemy import Connection, String, cast, insert, select, update

from backend.store.access.tables import invitations, login_sessions
from backend.store.backups.archive import RUNS, STORE_FILE, Contents, open_archive, read_contents, store_settings
from backend.store.backups.placing import FilePlacer
from backend.store.backups.rows import Tell, copy_rows, count_rows, delete_rows
from backend.store.database import Database, current_time, open_database
from backend.store.errors import WouldOverwrite
from backend.store.full_disk import explain_no_room
from backend.store.outcomes import HandedBack, end_attempt
from backend.store.settings import Settings
from backend.store.states import RunState
from backend.store.storage import FileStorage
from backend.store.tables import (
    attempts,
    metadata,
    run_files,
    runs,
    viewer_hosts,
    viewer_sessions,
    webhook_deliveries,
    workers,
)
from backend.store.workers import list_workers

FENCE_LEAP = 1000
"""Added to every fence: an attempt that lived on since the backup must find its own too old."""
PRESENCE = (workers, viewer_hosts, viewer_sessions)
"""Tables about processes: rows in them alone do not make a store worth keeping."""


@dataclass(frozen=True)
class RestoreReport:
    """Say what was restored."""

    made_at: str
    """When the backup was made."""
    runs: int
    files: int
    queued_again: int
    """Runs that were being trained when the backup was made."""


def restore_backup(settings: Settings, source: Path, overwrite: bool, tell: Tell) -> RestoreReport:
    """Put the content of a backup into the store and the data directory of the settings.

    Args:
        overwrite: whether to replace what is there.
        tell: takes a sentence about how far it is.

    Raises:
        BadFile: it is no whole backup, or is damaged.
        DiskTooFull: it does not fit; the store is what it was.
        StoreTooNew: a later version of this program has made it.
        StoreUnavailable: store or shared place cannot be used just now.
        WouldOverwrite: something is there, or a worker is at work.
    """
    source = source.absolute()
    db = open_database(settings)
    try:
        _check_target(db, settings, overwrite)
        scratch = settings.home
        with open_archive(source, scratch) as archive, TemporaryDirectory(prefix=".restore-", dir=scratch) as name:
            tell("Looking at every file of the backup.")
            contents = read_contents(archive, source)
            shutil.copyfile(archive / STORE_FILE, Path(name) / STORE_FILE)
            archived = open_database(store_settings(Path(name)))
            try:
                with explain_no_room("what is restored", settings.home):
                    return _restore(db, settings, archived, archive, contents, tell)
            finally:
                archived.close()
    finally:
        db.close()


def _check_target(db: Database, settings: Settings, overwrite: bool) -> None:
    alive = [worker for worker in list_workers(db) if worker.alive]
    if alive:
        raise WouldOverwrite(
            f"A worker is alive on {alive[0].host} (process {alive[0].pid}); "
            "stop the service and every worker, wait half a minute, and restore then."
        )
    if overwrite:
        return
    with db.read() as conn:
        is_used = any(count_rows(conn, table) for table in metadata.sorted_tables if table not in PRESENCE)
    if is_used:
        raise WouldOverwrite("The store holds runs already; name an empty one, or replace everything with --overwrite.")
    if settings.runs_directory.is_dir() and any(settings.runs_directory.iterdir()):
        raise WouldOverwrite(
            f"{settings.runs_directory} holds runs already; name an empty data directory with SLDR_HOME, "
            "or replace everything with --overwrite."
        )


def _restore(
    db: Database, settings: Settings, archived: Database, archive: Path, contents: Contents, tell: Tell
) -> RestoreReport:
    with archived.write() as conn:
        queued_again = _settle(conn)
    storage = FileStorage(settings)
    with _set_aside(settings.runs_directory):
        placer = FilePlacer(settings, storage, archive / RUNS)
        _place_files(archived, placer, tell)
        with db.read() as conn:
            before = set(conn.execute(select(runs.c.id)).scalars())
        with archived.read() as reader, db.write() as writer:
            delete_rows(writer)
            copy_rows(reader, writer, tell)
    if storage.shared is not None:
        placer.sweep(storage.shared, before)
    return RestoreReport(contents.made_at, contents.runs, placer.count, queued_again)


def _settle(conn: Connection) -> int:
    """Let no run be in the hands of a worker, and no worker be alive; return how many runs are queued again."""
    at = current_time(conn)
    running = conn.execute(select(runs).where(runs.c.state == RunState.RUNNING)).all()
    for row in running:
        outcome = HandedBack("It was restored from a backup and goes on from its checkpoint.")
        end_attempt(conn, row, outcome, at, backoff_s=0.0)
    _leap(conn)
    conn.execute(update(workers).where(workers.c.retired_at.is_(None)).values(retired_at=at))
    for table in (viewer_sessions, viewer_hosts, login_sessions, invitations):
        conn.execute(table.delete())
    return len(running)


def _leap(conn: Connection) -> None:
    """Raise every fence, and with it what goes by one.

    The occasion of what was told of a failed run, which would be told once more, and the fences of past attempts:
    what a machine has trained since the backup bears a lower one, and nobody takes it for a part of what was restored.
    """
    fence = select(runs.c.fence).where(runs.c.id == webhook_deliveries.c.subject).scalar_subquery()
    told = (webhook_deliveries.c.event == "run_failed", webhook_deliveries.c.occasion == cast(fence, String))
    conn.execute(update(webhook_deliveries).where(*told).values(occasion=cast(fence + FENCE_LEAP, String)))
    for table in (runs, attempts):
        conn.execute(update(table).values(fence=table.c.fence + FENCE_LEAP))


def _place_files(archived: Database, placer: FilePlacer, tell: Tell) -> None:
    """Put every file where the settings say, and write down where that is."""
    with archived.write() as conn:
        rows = conn.execute(select(run_files).order_by(run_files.c.run_id, run_files.c.name)).all()
        for number, row in enumerate(rows, start=1):
            tell(f"Files: {number} of {len(rows)}.")
            path = placer.place(row.run_id, row.name, row.attempt, row.sha256)
            this = (run_files.c.run_id == row.run_id, run_files.c.name == row.name)
            conn.execute(update(run_files).where(*this).values(path=path))
        newest = {row.id: row.attempt for row in conn.execute(select(runs.c.id, runs.c.attempt))}
        for values in placer.place_unlisted(newest):
            conn.execute(insert(run_files).values(**values, created_at=current_time(conn)))


@contextmanager
def _set_aside(directory: Path) -> Generator[None]:
    """Keep what a directory holds out of the way; bring it back if the block fails, else remove it."""
    aside, done = (directory.with_name(f".{directory.name}.{word}") for word in ("replaced", "removed"))
    shutil.rmtree(done, ignore_errors=True)  # of a restore that was killed while it tidied up
    if aside.is_dir():
        _bring_back(aside, directory)
    if directory.is_dir():
        directory.rename(aside)
    try:
        yield
    except BaseException:
        shutil.rmtree(directory, ignore_errors=True)
        if aside.is_dir():
            aside.rename(directory)
        raise
    if aside.is_dir():
        aside.rename(done)
        shutil.rmtree(done, ignore_errors=True)


def _bring_back(aside: Path, directory: Path) -> None:
    """Undo what a restore that was killed has done to a directory: the rows that were there tell of these files."""
    directory.mkdir(exist_ok=True)
    for kept in aside.iterdir():
        shutil.rmtree(directory / kept.name, ignore_errors=True)
        kept.rename(directory / kept.name)
    aside.rmdir()
