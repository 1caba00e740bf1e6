"""Packing a study: its runs that have succeeded, the locomotion runs that gave them their models, and their files."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any
from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile

from sqlalchemy import Connection, select

from backend.store.database import Database
from backend.store.errors import Refused
from backend.store.files import FileRow, list_files
from backend.store.locomotion import TRAIN, ZOO
from backend.store.metrics import read_metrics
from backend.store.settings import Settings
from backend.store.states import RunState
from backend.store.storage import FileStorage
from backend.store.studies.launch import find_study
from backend.store.studies.spec import LONGEST_NOTE, on_one_line
from backend.store.study_files.archive import LARGEST_SUM
from backend.store.study_files.chosen_files import EPISODES, EpisodeChoice, choose_files, keeps_episodes, kind_of
from backend.store.study_files.machines import count_machines, find_machines
from backend.store.study_files.records import (
    FORMAT,
    STUDY_MEMBER,
    Curve,
    Curves,
    EpisodeRecord,
    EventRecord,
    Member,
    Place,
    ProgressRecord,
    RunFile,
    RunRecord,
    SpecRecord,
    StudyFile,
    StudyRecord,
    file_member,
    metrics_member,
)
from backend.store.tables import AnyRow, episodes, run_events, run_needs, run_progress, runs, study_runs
from sldr_core.disk import write_atomically

PACKAGES = ("sldr", "torch", "numpy", "mujoco", "mjbatch", "gymnasium-robotics")

ReadWeights = Callable[[Path], bytes]
"""Return what goes into a study file of a policy or a locomotion model."""


@dataclass(frozen=True)
class Packed:
    """Say what a study file holds."""

    runs: int
    left_out: int
    """Places of the study whose run has not succeeded."""
    size: int
    """Of the file [bytes]."""


@dataclass(frozen=True)
class Members:
    """The runs of a study that go into its file."""

    study: AnyRow
    places: Mapping[str, Place]
    """Where runs stand, by their ids, also those that are left out."""
    objects: Sequence[AnyRow]
    """Locomotion runs that gave a model."""
    robots: Sequence[AnyRow]
    needs: Mapping[str, Sequence[str]]
    """Ids of the locomotion runs that a run has learnt from."""
    trained_on: Mapping[str, str]
    """The machine of a run's last attempt, in a few words that name nobody."""
    machine: str
    """All that trained, in the same way."""


def pack_study(
    db: Database,
    settings: Settings,
    study_id: str,
    out: Path,
    episodes_of: EpisodeChoice = "every",
    read_weights: ReadWeights = Path.read_bytes,
) -> Packed:
    """Write a study file.

    Args:
        db: the store that has the study.
        settings: where the files of its runs are.
        study_id: the study.
        out: the file to write.
        episodes_of: whose recorded episodes are packed; they are a good part of the file.
        read_weights: reads policies and locomotion models, and may make them smaller.

    Raises:
        NotFound: there is no such study.
        Refused: none of its runs has succeeded yet, or it is larger than what is taken in elsewhere.
        FileGone: a file of a run is no longer there.
        BadFile: it has changed since it was registered.
        FilesUnavailable: the shared place cannot be read just now.
    """
    members = _find_members(db, study_id)
    if not members.robots:
        raise Refused(f"No run of study '{members.study.name}' has succeeded yet; export it once one has.")
    storage, packed_runs = FileStorage(settings), (*members.objects, *members.robots)

    def write(path: Path) -> None:
        with ZipFile(path, "w", ZIP_DEFLATED, compresslevel=9) as archive:
            packed_places = {row.id: members.places[row.id] for row in members.robots}
            records: list[RunRecord] = []
            size = 0
            for row in packed_runs:
                files = choose_files(list_files(db, row.id), keeps_episodes(episodes_of, row.id, packed_places))
                packed_files = [_pack_file(storage, archive, file, read_weights) for file in files]
                records.append(_pack_run(db, archive, row, members, packed_files))
                size += sum(member.size for member in (*packed_files, records[-1].metrics))
                _check_size(size, members.study)
            content = StudyFile(
                format=FORMAT,
                made_at=datetime.now(UTC),
                versions={package: version(package) for package in PACKAGES},
                machine=members.machine,
                study=_pack_study(members.study),
                runs=records,
            )
            archive.writestr(STUDY_MEMBER, content.model_dump_json(indent=1))

    write_atomically(out, write)
    return Packed(len(packed_runs), len(members.places) - len(members.robots), out.stat().st_size)


def _check_size(size: int, study: AnyRow) -> None:
    if size > LARGEST_SUM:
        raise Refused(
            f"Study '{study.name}' holds more than the {LARGEST_SUM / 2**30:.0f} GB that an import takes; "
            f"`sldr export study {study.id} OUT.zip --episodes-of none --half` leaves out what it can. "
            "If that is too much as well, make two studies of it."
        )


def _find_members(db: Database, study_id: str) -> Members:
    with db.read() as conn:
        study = find_study(conn, study_id)
        rows = conn.execute(select(study_runs).where(study_runs.c.study_id == study_id)).all()
        places = {
            row.run_id: Place(task=row.task, method=row.method, variant=row.variant, seed=row.seed) for row in rows
        }
        robots = _succeeded(conn, places)
        pairs = conn.execute(select(run_needs).where(run_needs.c.run_id.in_([row.id for row in robots]))).all()
        objects = _succeeded(conn, {pair.needs_run_id for pair in pairs})
        machine = count_machines(conn, list(places))
        trained_on = find_machines(conn, [row.id for row in (*objects, *robots)])
    there = {row.id for row in objects}
    needs = {
        row.id: [pair.needs_run_id for pair in pairs if pair.run_id == row.id and pair.needs_run_id in there]
        for row in robots
    }
    return Members(study, places, objects, robots, needs, trained_on, machine)


def _succeeded(conn: Connection, ids: Collection[str]) -> Sequence[AnyRow]:
    done = (runs.c.state == RunState.SUCCEEDED, runs.c.deleted_at.is_(None))
    return conn.execute(select(runs).where(runs.c.id.in_(list(ids)), *done).order_by(runs.c.number)).all()


def _pack_study(study: AnyRow) -> StudyRecord:
    # Earlier versions may have left a longer note, or a name of several lines, than anybody may write.
    return StudyRecord(name=on_one_line(study.name), note=study.note[:LONGEST_NOTE], spec=_spec(study.spec))


def _spec(values: Mapping[str, Any]) -> SpecRecord:
    """Return the axes; runs that a person named as locomotion runs are unknown elsewhere."""
    choice = values.get("locomotion", TRAIN)
    return SpecRecord.model_validate(
        {**values, "locomotion": choice if choice in (ZOO, TRAIN) else TRAIN}, strict=False
    )


def _pack_file(storage: FileStorage, archive: ZipFile, file: FileRow, read_weights: ReadWeights) -> RunFile:
    kind, source = kind_of(file.name), storage.bring(file)
    content = source.read_bytes() if kind == EPISODES else read_weights(source)
    # It is packed already.
    archive.writestr(file_member(file.run_id, file.name), content, ZIP_STORED)
    return RunFile(name=file.name, kind=kind, size=len(content), sha256=hashlib.sha256(content).hexdigest())


def _pack_run(
    db: Database, archive: ZipFile, row: AnyRow, members: Members, packed_files: Sequence[RunFile]
) -> RunRecord:
    curves = json.dumps(_curves(db, row.id).model_dump(), separators=(",", ":")).encode()
    archive.writestr(metrics_member(row.id), curves)
    kept = {file.name for file in packed_files}
    with db.read() as conn:
        progress = conn.execute(select(run_progress).where(run_progress.c.run_id == row.id)).mappings().one_or_none()
        shown = conn.execute(select(episodes).where(episodes.c.run_id == row.id, episodes.c.file.in_(kept)))
        listed = [EpisodeRecord(**_fields(EpisodeRecord, found)) for found in shown.mappings()]
        history = conn.execute(select(run_events).where(run_events.c.run_id == row.id).order_by(run_events.c.id))
        events = [EventRecord(**_fields(EventRecord, found)) for found in history.mappings()]
    return RunRecord(
        key=row.id,
        preset=row.preset,
        config=row.config,
        success_rate=row.success_rate,
        created_at=row.created_at,
        started_at=row.started_at,
        ended_at=row.ended_at,
        needs=list(members.needs.get(row.id, ())),
        machine=members.trained_on.get(row.id, ""),
        place=members.places.get(row.id),
        progress=None if progress is None else ProgressRecord(**_fields(ProgressRecord, progress)),
        events=events,
        episodes=listed,
        files=list(packed_files),
        metrics=Member(size=len(curves), sha256=hashlib.sha256(curves).hexdigest()),
    )


def _curves(db: Database, run_id: str) -> Curves:
    """Return the curves of a run as a later reader sees them: one attempt, without what was superseded."""
    steps: list[tuple[int, int, int, int, int, float]] = []
    metrics: dict[str, Curve] = {}
    for columns in _pieces(db, run_id):
        first = len(steps)
        names = (
            columns.step,
            columns.epoch,
            columns.env_steps,
            columns.episodes,
            columns.updates,
            columns.wall_seconds,
        )
        steps.extend(zip(*names, strict=True))
        for name, values in columns.values.items():
            curve = metrics.setdefault(name, Curve(at=[], values=[]))
            for place, value in enumerate(values, start=first):
                if value is not None:
                    curve.at.append(place)
                    curve.values.append(value)
    return Curves(steps=steps, metrics=metrics)


def _pieces(db: Database, run_id: str) -> Iterator[Any]:
    after = 0
    while (columns := read_metrics(db, run_id, after)).step:
        yield columns
        after = columns.cursor


def _fields(record: type[EpisodeRecord | EventRecord | ProgressRecord], row: Any) -> dict[str, Any]:
    return {name: row[name] for name in record.model_fields}
