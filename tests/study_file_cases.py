"""A study of two methods with what workers leave behind, and study files that were tampered with."""

from __future__ import annotations

import hashlib
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any
from zipfile import ZIP_DEFLATED, ZipFile

from plausible_runs import play_out
from recorded_tests import made_test
from sqlalchemy import insert

from backend.store.database import Database
from backend.store.settings import Settings
from backend.store.storage import checksum
from backend.store.studies.launch import create_study
from backend.store.studies.matrix import get_study
from backend.store.studies.spec import StudySpec
from backend.store.tables import episodes, run_files, runs
from sldr_core.episodes import episodes_file, write_episodes

EPOCH = 3
EPISODE = {
    "epoch": EPOCH,
    "number": 0,
    "attempt": 1,
    "file": episodes_file(EPOCH),
    "success": False,
    "tag": "other",
    "task_return": -4.0,
    "worst_q": -0.5,
    "worst_q_step": 2,
    "length": 4,
    "resimulates": True,
}
SPEC = StudySpec(("FetchPush",), ("her", "her-sldr"), (0, 1), "smoke")


def trained_study(db: Database, settings: Settings, name: str = "Two methods") -> str:
    """Launch a study, let it be trained, and put files beside its runs; return its id."""
    study_id = create_study(db, name, SPEC, "What was asked.").study_id
    play_out(db, epochs=EPOCH)
    play_out(db, epochs=EPOCH)
    matrix = get_study(db, study_id)
    for run in matrix.locomotion:
        put_file(db, settings, run.run_id, "locomotion.pt", "locomotion", archive_of(b"a model"))
    for run in (run for cell in matrix.cells for run in cell.runs):
        put_file(db, settings, run.run_id, "policy-best.pt", "policy", archive_of(b"the best"))
        put_file(db, settings, run.run_id, "policy-newest.pt", "policy", archive_of(b"the newest"))
        put_file(db, settings, run.run_id, "checkpoint.pt", "checkpoint", archive_of(b"no one needs it"))
        path = settings.run_directory(run.run_id) / episodes_file(EPOCH)
        write_episodes(path, made_test(epoch=EPOCH))
        put_file(db, settings, run.run_id, path.name, "episodes", path.read_bytes())
        with db.write() as conn:
            conn.execute(insert(episodes).values(run_id=run.run_id, **EPISODE))
    return study_id


def put_file(db: Database, settings: Settings, run_id: str, name: str, kind: str, content: bytes) -> None:
    """Put a file into a run's directory, and list it."""
    path = settings.run_directory(run_id) / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    with db.write() as conn:
        at = conn.execute(runs.select().where(runs.c.id == run_id)).one().created_at
        values = {"run_id": run_id, "name": name, "kind": kind, "path": str(path.relative_to(settings.home))}
        sums = {"size": len(content), "sha256": checksum(path), "attempt": 1, "created_at": at}
        conn.execute(insert(run_files).values(**values, **sums))


def archive_of(content: bytes) -> bytes:
    """Return a small archive, as torch's files are."""
    packed = io.BytesIO()
    with ZipFile(packed, "w") as archive:
        archive.writestr("data", content)
    return packed.getvalue()


def members_of(source: Path) -> dict[str, bytes]:
    """Return all that a study file holds."""
    with ZipFile(source) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def write_members(target: Path, members: dict[str, bytes]) -> Path:
    """Write a study file."""
    with ZipFile(target, "w", ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    return target


def changed(source: Path, target: Path, change: Callable[[dict[str, Any]], object]) -> Path:
    """Write a study file whose list was changed."""
    members = members_of(source)
    listed = json.loads(members["study.json"])
    change(listed)
    members["study.json"] = json.dumps(listed).encode()
    return write_members(target, members)


def with_curves(source: Path, target: Path, change: Callable[[dict[str, Any]], object]) -> Path:
    """Write a study file in which the curves of the first run were changed, with a list that says so."""
    members = members_of(source)
    listed = json.loads(members["study.json"])
    name = f"metrics/{listed['runs'][0]['key']}.json"
    curves = json.loads(members[name])
    change(curves)
    members[name] = json.dumps(curves).encode()
    listed["runs"][0]["metrics"] = sums_of(members[name])
    members["study.json"] = json.dumps(listed).encode()
    return write_members(target, members)


def with_file(source: Path, target: Path, run: int, content: bytes) -> Path:
    """Write a study file in which the last file of a run is another, with a list that says so."""
    members = members_of(source)
    listed = json.loads(members["study.json"])
    file = listed["runs"][run]["files"][-1]
    file.update(sums_of(content))
    members[f"runs/{listed['runs'][run]['key']}/{file['name']}"] = content
    members["study.json"] = json.dumps(listed).encode()
    return write_members(target, members)


def sums_of(content: bytes) -> dict[str, Any]:
    """Return size and checksum."""
    return {"size": len(content), "sha256": hashlib.sha256(content).hexdigest()}


def everything_below(directory: Path) -> set[str]:
    """Return the path of every file and directory below a directory."""
    return {str(path.relative_to(directory)) for path in directory.rglob("*")}
