"""Taking in a study file: checked as a whole before anything is written, then placed in one transaction."""

from __future__ import annotations

import hashlib
import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import BinaryIO

from pydantic import ValidationError

from backend.store.database import LAUNCH_TURN, Database, current_time, take_turn
from backend.store.run_plans import RUN_ID_LENGTH
from backend.store.settings import Settings
from backend.store.states import Event
from backend.store.storage import FileStorage
from backend.store.studies.launch import STUDY_ID_LENGTH
from backend.store.studies.spec import (
    LONGEST_NAME,
    Cell,
    StudySpec,
    check_name,
    check_spec,
    make_configs,
    spec_from_dict,
)
from backend.store.studies.spec import Place as SpecPlace
from backend.store.study_files.archive import HostileArchive
from backend.store.study_files.records import (
    STUDY_MEMBER,
    Curves,
    RunRecord,
    StudyFile,
    file_member,
    metrics_member,
)
from backend.store.study_files.rows import StudyRows, insert_study, is_there, revive, taken_ids
from sldr_core.config import TrainConfig, config_from_dict
from sldr_core.disk import write_atomically
from sldr_core.episodes import TAGS, epoch_of, read_episodes
from sldr_core.errors import BadFile, SldrError
from sldr_core.presets import find_preset

LARGEST_LIST = 64 * 2**20
"""Of `study.json` [bytes]."""
LARGEST_UPLOAD = 512 * 2**20
"""Of a study file [bytes]."""


LARGEST_SEED = 2**63 - 1
EVENTS = frozenset(Event)


@dataclass(frozen=True)
class Imported:
    """Say what an import has done."""

    study_id: str
    runs: int
    already_there: bool
    """Whether the same file was imported before; nothing was changed then."""


def import_study(db: Database, settings: Settings, source: Path | BinaryIO, called: str) -> Imported:
    """Take in a study file. The same file twice is the same study.

    Args:
        source: the file.
        called: what the user calls it.

    Raises:
        BadFile: it is no study file, is damaged, or holds what no study file of ours does; nothing was written.
        DiskTooFull: there is no room for it.
        FilesUnavailable: the shared place cannot be written just now.
    """
    with HostileArchive(source, called) as archive:
        listed = archive.read(STUDY_MEMBER, LARGEST_LIST)
        digest = hashlib.sha256(listed).hexdigest()
        content = _parsed(listed, called)
        rows = _checked(content, digest, called)
        _expect_members(archive, content)
        curves = {run.key: _curves(archive, run, called) for run in content.runs}
        with db.read() as conn:
            known, taken = is_there(conn, rows.study_id), taken_ids(conn, rows)
        if known:
            return _found_again(db, rows)
        if taken:
            raise BadFile(f"{called} would take the id of run {taken[0]}, which is another; it is not taken.")
        placed = _place_files(archive, settings, content, rows)
    try:
        with db.write() as conn:
            take_turn(conn, LAUNCH_TURN)
            if not is_there(conn, rows.study_id):
                insert_study(conn, rows, curves, placed, current_time(conn))
    except BaseException:
        _remove(settings, rows)
        raise
    return Imported(rows.study_id, len(content.runs), already_there=False)


def _parsed(listed: bytes, called: str) -> StudyFile:
    try:
        return StudyFile.model_validate_json(listed)
    except ValidationError as err:
        first = err.errors(include_url=False)[0]
        where = ".".join(str(part) for part in first["loc"]) or STUDY_MEMBER
        raise BadFile(f"{called} is no study file that this version reads: {where:.200}: {first['msg']:.200}.") from err


def _checked(content: StudyFile, digest: str, called: str) -> StudyRows:
    """Return what will be stored, once everything fits together."""
    try:
        spec = spec_from_dict(content.study.spec.model_dump())
        check_spec(spec)
        make_configs(spec, spec.places)
        name = check_name(content.study.name[:LONGEST_NAME])
        configs = {run.key: config_from_dict(run.config) for run in content.runs}
        for run in content.runs:
            find_preset(run.preset)
    except (SldrError, AttributeError, KeyError, TypeError, ValueError, RecursionError) as err:
        raise BadFile(f"{called} asks for what this version does not have: {err!s:.300}.") from err
    if len(configs) != len(content.runs):
        raise BadFile(f"{called} holds a run twice; it is not taken.")
    places: set[SpecPlace] = set()
    for run in content.runs:
        problem = _problem(run, configs, spec, places)
        if problem is not None:
            raise BadFile(f"{called} does not fit together: run {run.key} {problem}; it is not taken.")
    ids = {key: hashlib.sha256(f"{digest}:{key}".encode()).hexdigest()[:RUN_ID_LENGTH] for key in configs}
    return StudyRows(digest[:STUDY_ID_LENGTH], name, content, spec, configs, ids, digest)


def _problem(run: RunRecord, configs: Mapping[str, TrainConfig], spec: StudySpec, places: set[SpecPlace]) -> str | None:
    config = configs[run.key]
    if any(configs.get(key) is None or configs[key].phase != "locomotion" for key in run.needs):
        return "needs a locomotion run that is not there"
    if len(set(run.needs)) != len(run.needs) or run.key in run.needs:
        return "needs a run twice"
    names = [file.name for file in run.files]
    if len(set(names)) != len(names):
        return "has a file twice"
    if not all(event.event in EVENTS for event in run.events):
        return "has had something happen that cannot"
    if config.seed > LARGEST_SEED:
        return "has a seed that is too large"
    if len({(episode.epoch, episode.number) for episode in run.episodes}) != len(run.episodes):
        return "has an episode twice"
    for episode in run.episodes:
        if episode.file not in names or epoch_of(episode.file) != episode.epoch or episode.tag not in TAGS:
            return f"has an episode of epoch {episode.epoch} that no file holds"
    if run.place is None:
        return None if config.phase == "locomotion" else "stands nowhere in the study"
    place = SpecPlace(Cell(run.place.task, run.place.method, run.place.variant), run.place.seed)
    said = (config.phase, config.task, config.method, config.seed)
    if place in places or place not in spec.places or said != ("manipulation", *_told(place)):
        return "stands where it cannot"
    places.add(place)
    return None


def _told(place: SpecPlace) -> tuple[str, str, int]:
    return place.cell.task, place.cell.method, place.seed


def _expect_members(archive: HostileArchive, content: StudyFile) -> None:
    files = [file_member(run.key, file.name) for run in content.runs for file in run.files]
    archive.expect([STUDY_MEMBER, *files, *(metrics_member(run.key) for run in content.runs)])


def _curves(archive: HostileArchive, run: RunRecord, called: str) -> Curves:
    packed = archive.read_member(metrics_member(run.key), run.metrics)
    try:
        curves = Curves.model_validate_json(packed)
    except ValidationError as err:
        raise BadFile(f"The curves of run {run.key} in {called} cannot be read; they are not taken.") from err
    cycles = [step[0] for step in curves.steps]
    if cycles != sorted(set(cycles)):
        raise BadFile(f"The cycles of run {run.key} in {called} are not in their order; it is not taken.")
    for name, curve in curves.metrics.items():
        if len(curve.at) != len(curve.values) or curve.at != sorted(set(curve.at)) or curve.at[-1:] >= [len(cycles)]:
            raise BadFile(f"The curve {name} of run {run.key} in {called} does not fit its cycles; it is not taken.")
    return curves


def _place_files(
    archive: HostileArchive, settings: Settings, content: StudyFile, rows: StudyRows
) -> dict[tuple[str, str], str]:
    """Write the files of all runs below the data directory; return the paths of their rows by key and name."""
    storage = FileStorage(settings)
    placed: dict[tuple[str, str], str] = {}
    try:
        for run in content.runs:
            for file in run.files:
                packed = archive.read_member(file_member(run.key, file.name), file)
                # What lies within is an archive itself; weights and arrays are read as data alone, wherever they are.
                with HostileArchive(BytesIO(packed), f"{file.name} of run {run.key}"):
                    pass

                def write(path: Path, packed: bytes = packed) -> None:
                    path.write_bytes(packed)

                target = settings.run_directory(rows.ids[run.key]) / file.name
                target.parent.mkdir(parents=True, exist_ok=True)
                write_atomically(target, write)
                if file.kind == "episodes":
                    _look_at_episodes(target)
                placed[run.key, file.name] = storage.keep(rows.ids[run.key], 1, target, file.sha256)
    except BaseException:
        _remove(settings, rows)
        raise
    return placed


def _look_at_episodes(path: Path) -> None:
    try:
        read_episodes(path)
    except MemoryError as err:
        raise BadFile(f"{path.name} asks for more memory than there is; it is not taken.") from err


def _found_again(db: Database, rows: StudyRows) -> Imported:
    with db.write() as conn:
        revive(conn, rows)
    return Imported(rows.study_id, len(rows.ids), already_there=True)


def _remove(settings: Settings, rows: StudyRows) -> None:
    for run_id in rows.ids.values():
        shutil.rmtree(settings.run_directory(run_id), ignore_errors=True)
