"""Making a backup while everything runs.

The files are copied first and the rows after them. So the metrics go at least as far as every checkpoint, and a run
that goes on from a restored checkpoint leaves no gap in its curves. For the files of runs that are trained meanwhile,
the backup's rows are then set to the versions that were copied; those of ended runs are exactly what was registered.
"""

from __future__ import annotations

import shutil
import sqlite3
from contextlib import closing
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path

from sqlalchemy import delete, func, select, update

from backend.store.backups.archive import (
    RUNS,
    STORE_FILE,
    Contents,
    check_target,
    list_files_below,
    put_in_place,
    store_settings,
    write_contents,
)
from backend.store.backups.files import CannotCopy, FileCopier
from backend.store.backups.rows import Tell, copy_rows
from backend.store.database import Database, open_database
from backend.store.engines import parse_address
from backend.store.errors import FileGone, Refused
from backend.store.files import LOG_FILE, FileRow
from backend.store.full_disk import explain_no_room
from backend.store.inspection import inspect_store
from backend.store.settings import Settings
from backend.store.states import RunState
from backend.store.tables import run_files, runs
from sldr_core.errors import BadFile, DiskTooFull

SPARE_DISK = 64 * 2**20
"""Disk space left free beside the backup [bytes]."""


@dataclass(frozen=True)
class BackupReport:
    """Say what a backup holds."""

    path: Path
    runs: int
    files: int
    size: int
    """Of all files, unpacked [bytes]."""
    left_out: tuple[str, ...]
    """What should be in it and is not, a sentence each."""


def make_backup(settings: Settings, target: Path, overwrite: bool, tell: Tell) -> BackupReport:
    """Copy store and files to `target`; nothing needs to stop for it.

    Args:
        target: a directory, or a file if its name ends in .tar, .tar.gz or .tgz.
        overwrite: whether to replace what is there.
        tell: takes a sentence about how far it is.

    Raises:
        WouldOverwrite: something is there.
        Refused: the store's tables are of an earlier version, which would be migrated before there is a backup.
        DiskTooFull: it does not fit.
        StoreUnavailable: store or shared place cannot be used just now.
    """
    target = target.absolute()
    check_target(target, overwrite)
    _check_revision(settings)
    target.parent.mkdir(parents=True, exist_ok=True)
    stage = target.with_name(f".{target.name}.partial")
    if stage.exists():
        shutil.rmtree(stage)  # of a backup that was broken off
    stage.mkdir()
    db = open_database(settings)
    try:
        states, rows = _read_files(db)
        _check_disk(stage, rows)
        with explain_no_room(f"the backup {target.name}", target.parent):
            report = _fill(db, settings, stage, target, states, rows, tell)
            put_in_place(stage, target)
    finally:
        db.close()
        shutil.rmtree(stage, ignore_errors=True)
    return report


def _check_revision(settings: Settings) -> None:
    state = inspect_store(settings)
    if state.revision is not None and state.revision < state.expected:
        raise Refused(
            f"The store's tables are of revision {state.revision}, and this version would bring them to "
            f"{state.expected} first; make the backup with the version that has used the store so far."
        )


def _fill(
    db: Database,
    settings: Settings,
    stage: Path,
    target: Path,
    states: dict[str, RunState],
    rows: list[FileRow],
    tell: Tell,
) -> BackupReport:
    copier = FileCopier(db, settings, stage)
    left_out: dict[tuple[str, str], str] = {}
    for number, row in enumerate(rows, start=1):
        tell(f"Files: {number} of {len(rows)}.")
        _try_to_copy(copier, row, states, left_out)
    _copy_store(db, settings, stage, tell)
    archived = open_database(store_settings(stage))
    try:
        _settle_files(archived, copier, left_out)
        run_count = _finish_store(archived, copier)
    finally:
        archived.close()
    _pack_store(stage)
    files = list_files_below(stage)
    write_contents(stage, Contents(datetime.now(UTC).isoformat(), version("sldr"), run_count, files))
    size = sum(file.size for file in files)
    return BackupReport(target, run_count, len(files), size, tuple(left_out.values()))


def _read_files(db: Database) -> tuple[dict[str, RunState], list[FileRow]]:
    """Return the state of every run, and every registered file."""
    with db.read() as conn:
        states = {row.id: RunState(row.state) for row in conn.execute(select(runs.c.id, runs.c.state))}
        query = select(run_files).order_by(run_files.c.run_id, run_files.c.name)
        rows = [FileRow(**row) for row in conn.execute(query).mappings()]
    return states, rows


def _check_disk(stage: Path, rows: list[FileRow]) -> None:
    needed = sum(row.size for row in rows)
    free = shutil.disk_usage(stage).free
    if free < needed + SPARE_DISK:
        raise DiskTooFull(
            f"The backup {stage.parent} needs {needed / 1e9:.1f} GB and more, and its disk has {free / 1e9:.1f} GB "
            "free; free some space, or make it elsewhere."
        )


def _try_to_copy(
    copier: FileCopier,
    row: FileRow,
    states: dict[str, RunState],
    left_out: dict[tuple[str, str], str],
    exactly: bool = False,
) -> None:
    key = (row.run_id, row.name)
    try:
        copier.copy(row, states.get(row.run_id) is not RunState.SUCCEEDED, exactly)
        if key in copier.copied:
            left_out.pop(key, None)
    except CannotCopy as err:
        left_out[key] = str(err)


def _copy_store(db: Database, settings: Settings, stage: Path, tell: Tell) -> None:
    """Copy all rows as they are at one moment."""
    if db.engine_name == "sqlite":
        source = parse_address(settings.database_url).database
        assert source is not None
        with closing(sqlite3.connect(source)) as reader, closing(sqlite3.connect(stage / STORE_FILE)) as writer:
            reader.backup(writer)
        return
    archived = open_database(store_settings(stage))
    try:
        with db.read() as reader, archived.write() as writer:
            copy_rows(reader, writer, tell)
    finally:
        archived.close()


def _settle_files(archived: Database, copier: FileCopier, left_out: dict[tuple[str, str], str]) -> None:
    """Make the backup's rows and the files beside them agree; see the top of this file."""
    states, rows = _read_files(archived)
    # What was dropped meanwhile, as episodes of old tests are, is not missed.
    for key in left_out.keys() - {(row.run_id, row.name) for row in rows}:
        del left_out[key]
    for row in rows:
        if row.name == LOG_FILE:
            _copy_log(copier, row, left_out)
        elif not copier.holds(row):
            _try_to_copy(copier, row, states, left_out, exactly=True)
        there = copier.copied.get((row.run_id, row.name))
        this = (run_files.c.run_id == row.run_id, run_files.c.name == row.name)
        with archived.write() as conn:
            if there is None:
                conn.execute(delete(run_files).where(*this))
                continue
            fields = {name: getattr(there, name) for name in ("kind", "size", "sha256", "attempt", "created_at")}
            path = f"{RUNS}/{row.run_id}/{row.name}"
            conn.execute(update(run_files).where(*this).values(path=path, **fields))


def _copy_log(copier: FileCopier, row: FileRow, left_out: dict[tuple[str, str], str]) -> None:
    try:
        copier.copy_log(row)
    except (BadFile, FileGone) as err:
        left_out[row.run_id, row.name] = str(err)


def _finish_store(archived: Database, copier: FileCopier) -> int:
    """Copy what is not registered beside the files of every run; return how many runs there are."""
    with archived.read() as conn:
        for run_id in conn.execute(select(runs.c.id)).scalars():
            copier.copy_unlisted(run_id)
        return conn.execute(select(func.count()).select_from(runs)).scalar_one()


def _pack_store(stage: Path) -> None:
    """Bring all of the store into its one file."""
    with closing(sqlite3.connect(stage / STORE_FILE)) as connection:
        connection.execute("PRAGMA journal_mode=DELETE")
    for left in stage.glob(f"{STORE_FILE}*"):
        if left.name != STORE_FILE:
            left.unlink()
