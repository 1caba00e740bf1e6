"""Taking in a study file: checked as a whole before anything is written, then placed in one transaction."""

from __future__ import annotations

import shutil
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import BinaryIO

from backend.store.database import LAUNCH_TURN, Database, current_time, take_turn
from backend.store.full_disk import explain_no_room
from backend.store.settings import Settings
from backend.store.storage import FileStorage
from backend.store.study_files.archive import HostileArchive
from backend.store.study_files.checking import read_curves, read_study
from backend.store.study_files.records import Curves, file_member
from backend.store.study_files.rows import (
    StudyRows,
    insert_files,
    insert_study,
    is_there,
    known_files,
    revive,
    taken_ids,
)
from sldr_core.disk import hold_lock, write_atomically
from sldr_core.episodes import read_episodes
from sldr_core.errors import BadFile

LARGEST_STUDY_FILE = 512 * 2**20
"""A longer file is not taken from a page [bytes]."""
ATTEMPT = 1
IMPORT_LOCK = "import.lock"
"""Held in the data directory by the one who takes in a file."""


@dataclass(frozen=True)
class Imported:
    """Say what an import has done."""

    study_id: str
    runs: int
    already_there: bool
    """Whether the same file was imported before; at most what was deleted or removed of it is back then."""


def import_study(db: Database, settings: Settings, source: Path | BinaryIO, called: str) -> Imported:
    """Take in a study file. The same file twice is the same study, and brings back what was removed of it.

    Args:
        source: the file.
        called: what the user calls it.

    Raises:
        BadFile: it is no study file, is damaged, or holds what no study file of ours does; nothing is left of it.
        DiskTooFull: there is no room for it.
        FilesUnavailable: the shared place cannot be written just now.
    """
    with HostileArchive(source, called) as archive, explain_no_room("the study", settings.home):
        rows = read_study(archive, called)
        # Of two imports of the same file, one would remove or replace what the other has just placed.
        with hold_lock(settings.home / IMPORT_LOCK):
            already_there = _revive(db, rows)
            if already_there:
                _bring_back(db, archive, settings, rows)
            else:
                already_there = _take_in(db, archive, settings, rows, called)
    return Imported(rows.study_id, len(rows.ids), already_there)


def _revive(db: Database, rows: StudyRows) -> bool:
    """Bring back what was deleted of a study, if it is there; return whether it is."""
    with db.write() as conn:
        there = is_there(conn, rows.study_id)
        if there:
            revive(conn, rows)
    return there


def _bring_back(db: Database, archive: HostileArchive, settings: Settings, rows: StudyRows) -> None:
    """Place the files of a study that were removed since it was imported."""
    with db.read() as conn:
        known = known_files(conn, rows)
    lacking = {
        (run.key, file.name)
        for run in rows.content.runs
        for file in run.files
        if (run.key, file.name) not in known or not (settings.run_directory(rows.ids[run.key]) / file.name).is_file()
    }
    placed = _place_files(archive, settings, rows, lacking)
    with db.write() as conn:
        insert_files(
            conn, rows, {place: path for place, path in placed.items() if place not in known}, current_time(conn)
        )


def _take_in(db: Database, archive: HostileArchive, settings: Settings, rows: StudyRows, called: str) -> bool:
    """Place and store a study that is not there; return whether another machine has just done so."""
    with db.read() as conn:
        taken = taken_ids(conn, rows)
    if taken:
        raise BadFile(f"{called} would take the id of run {taken[0]}, which is another; it is not taken.")
    curves = {run.key: read_curves(archive, run, called) for run in rows.content.runs}
    try:
        placed = _place_files(archive, settings, rows)
        return _insert(db, rows, curves, placed)
    except BaseException:
        _remove(db, settings, rows)
        raise


def _insert(db: Database, rows: StudyRows, curves: Mapping[str, Curves], placed: Mapping[tuple[str, str], str]) -> bool:
    """Store the rows; return whether someone else has just done so."""
    with db.write() as conn:
        take_turn(conn, LAUNCH_TURN)
        if is_there(conn, rows.study_id):
            return True
        insert_study(conn, rows, curves, placed, current_time(conn))
    return False


def _place_files(
    archive: HostileArchive, settings: Settings, rows: StudyRows, chosen: Collection[tuple[str, str]] | None = None
) -> dict[tuple[str, str], str]:
    """Write files of runs below the data directory; return the paths of their rows by key and name.

    Args:
        chosen: keys and names of those to write; all of them if None.
    """
    storage = FileStorage(settings)
    placed: dict[tuple[str, str], str] = {}
    for run in rows.content.runs:
        directory = settings.run_directory(rows.ids[run.key])
        for file in run.files:
            if chosen is not None and (run.key, file.name) not in chosen:
                continue
            packed = archive.read_member(file_member(run.key, file.name), file)
            target = directory / file.name
            _place(packed, target)
            if file.kind == "episodes":
                _look_at_episodes(target)
            placed[run.key, file.name] = storage.keep(rows.ids[run.key], ATTEMPT, target, file.sha256)
    return placed


def _place(packed: bytes, target: Path) -> None:
    # What lies within is an archive itself; its weights or arrays are read as data alone, whenever they are.
    with HostileArchive(BytesIO(packed), target.name):
        pass

    def write(path: Path) -> None:
        path.write_bytes(packed)

    target.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(target, write)


def _look_at_episodes(path: Path) -> None:
    try:
        read_episodes(path)
    except MemoryError as err:
        raise BadFile(f"{path.name} asks for more memory than there is; it is not taken.") from err


def _remove(db: Database, settings: Settings, rows: StudyRows) -> None:
    with db.read() as conn:
        if is_there(conn, rows.study_id):
            return  # the same file was taken in beside this, and its files are these
    for run_id in rows.ids.values():
        shutil.rmtree(settings.run_directory(run_id), ignore_errors=True)
