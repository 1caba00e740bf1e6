"""The rows of an imported study: runs that have succeeded elsewhere, marked as such, that no worker ever takes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from sqlalchemy import Connection, delete, insert, select, update

from backend.store.metrics import MetricPoint, store_points
from backend.store.order import last_position
from backend.store.states import Event, RunState, append_event
from backend.store.studies.spec import LONGEST_NAME, LONGEST_NOTE, StudySpec, spec_to_dict
from backend.store.study_files.machines import ELSEWHERE
from backend.store.study_files.records import Curves, RunRecord, StudyFile
from backend.store.tables import (
    attempts,
    episodes,
    file_removals,
    run_events,
    run_files,
    run_needs,
    run_progress,
    run_tags,
    runs,
    studies,
    study_runs,
)
from sldr_core.config import TrainConfig, config_hash, config_to_dict, settings_hash
from sldr_core.records import Step

IMPORTED_TAG = "imported"
"""What runs are tagged with that came in a study file."""
ATTEMPT = 1
"""All that was logged counts as one attempt: what was superseded is not in the file."""


@dataclass(frozen=True)
class StudyRows:
    """A study file that fits together, and what its parts are called here."""

    study_id: str
    name: str
    content: StudyFile
    spec: StudySpec
    configs: Mapping[str, TrainConfig]
    ids: Mapping[str, str]
    """Ids of the runs by their keys in the file."""
    digest: str
    """Of the file's list, which holds the checksum of everything else."""


def is_there(conn: Connection, study_id: str) -> bool:
    """Tell whether a study is in the store, deleted or not."""
    return conn.execute(select(studies.c.id).where(studies.c.id == study_id)).scalar_one_or_none() is not None


def taken_ids(conn: Connection, rows: StudyRows) -> list[str]:
    """Return which ids of the runs to come are those of runs that are there."""
    return list(conn.execute(select(runs.c.id).where(runs.c.id.in_(list(rows.ids.values())))).scalars())


def revive(conn: Connection, rows: StudyRows) -> None:
    """Bring back what was deleted of a study that is imported again, and let none of its files be removed."""
    conn.execute(delete(file_removals).where(file_removals.c.run_id.in_(list(rows.ids.values()))))
    deleted = (studies.c.id == rows.study_id, studies.c.deleted_at.is_not(None))
    name = conn.execute(select(studies.c.name).where(*deleted)).scalar_one_or_none()
    if name is not None:
        # Another study may have taken the name since.
        conn.execute(update(studies).where(*deleted).values(name=_free_name(conn, name), deleted_at=None))
    conn.execute(update(runs).where(runs.c.id.in_(list(rows.ids.values()))).values(deleted_at=None))


def known_files(conn: Connection, rows: StudyRows) -> set[tuple[str, str]]:
    """Return keys and names of the files that are registered here."""
    keys = {run_id: key for key, run_id in rows.ids.items()}
    query = select(run_files.c.run_id, run_files.c.name).where(run_files.c.run_id.in_(list(keys)))
    return {(keys[row.run_id], row.name) for row in conn.execute(query)}


def insert_files(conn: Connection, rows: StudyRows, placed: Mapping[tuple[str, str], str], at: datetime) -> None:
    """Register files of runs that are there, and their recorded episodes with them.

    Args:
        placed: where they lie, by key and name.
        at: now.
    """
    for run in rows.content.runs:
        _insert_files(conn, rows, run, placed, at)


def insert_study(
    conn: Connection,
    rows: StudyRows,
    curves: Mapping[str, Curves],
    placed: Mapping[tuple[str, str], str],
    at: datetime,
) -> None:
    """Store a study and all its runs.

    Args:
        curves: those of each run, by its key.
        placed: where the files lie, by key and name.
        at: now.
    """
    for run in rows.content.runs:
        _insert_run(conn, rows, run, placed, at)
        store_points(conn, rows.ids[run.key], ATTEMPT, _points(curves[run.key]))
    for run in rows.content.runs:
        edges = [{"run_id": rows.ids[run.key], "needs_run_id": rows.ids[key]} for key in run.needs]
        if edges:
            conn.execute(insert(run_needs), edges)
    conn.execute(
        insert(studies).values(
            id=rows.study_id,
            name=_free_name(conn, rows.name),
            note=_note(rows.content),
            preset=rows.spec.preset,
            spec=spec_to_dict(rows.spec),
            created_at=at,
        )
    )
    members = [
        {**run.place.model_dump(), "study_id": rows.study_id, "run_id": rows.ids[run.key]}
        for run in rows.content.runs
        if run.place is not None
    ]
    if members:
        conn.execute(insert(study_runs), members)


def _insert_run(
    conn: Connection, rows: StudyRows, run: RunRecord, placed: Mapping[tuple[str, str], str], at: datetime
) -> None:
    run_id = rows.ids[run.key]
    conn.execute(insert(runs).values(**_run_row(rows, run), queue_position=last_position(conn)))
    conn.execute(insert(attempts).values(**_attempt_row(rows, run)))
    conn.execute(insert(run_tags).values(run_id=run_id, tag=IMPORTED_TAG))
    if run.progress is not None:
        conn.execute(insert(run_progress).values(run_id=run_id, **run.progress.model_dump()))
    _insert_files(conn, rows, run, placed, at)
    if run.events:
        # The states in between are of no use here, and nobody can check them.
        common = {"run_id": run_id, "state": RunState.SUCCEEDED}
        conn.execute(insert(run_events), [{**common, **event.model_dump()} for event in run.events])
    detail = f"It came in a study file, sha256 {rows.digest[:12]}, made {rows.content.made_at:%Y-%m-%d}."
    append_event(conn, run_id, Event.IMPORTED, RunState.SUCCEEDED, at=at, attempt=ATTEMPT, detail=detail)


def _insert_files(
    conn: Connection, rows: StudyRows, run: RunRecord, placed: Mapping[tuple[str, str], str], at: datetime
) -> None:
    run_id = rows.ids[run.key]
    files = {file.name: file for file in run.files if (run.key, file.name) in placed}
    recorded = [episode for episode in run.episodes if episode.file in files]
    if files:
        lines = [_file_row(run_id, placed[run.key, name], file, at) for name, file in files.items()]
        conn.execute(insert(run_files), lines)
    if recorded:
        common = {"run_id": run_id, "attempt": ATTEMPT}
        conn.execute(insert(episodes), [{**common, **episode.model_dump()} for episode in recorded])


def _run_row(rows: StudyRows, run: RunRecord) -> dict[str, Any]:
    config = rows.configs[run.key]
    return {
        "id": rows.ids[run.key],
        "task": config.task,
        "phase": config.phase,
        "method": config.method,
        "seed": config.seed,
        "preset": run.preset,
        "config": config_to_dict(config),
        "config_hash": config_hash(config),
        "settings_hash": settings_hash(config),
        "state": RunState.SUCCEEDED,
        "success_rate": run.success_rate,
        "attempt": ATTEMPT,
        "origin": rows.digest,
        "created_at": run.created_at,
        "started_at": run.started_at,
        "ended_at": run.ended_at,
    }


def _attempt_row(rows: StudyRows, run: RunRecord) -> dict[str, Any]:
    started = run.started_at or run.created_at
    return {
        "run_id": rows.ids[run.key],
        "attempt": ATTEMPT,
        "fence": 0,
        "worker_id": ELSEWHERE,
        "host": run.machine or rows.content.machine,
        "started_at": started,
        # A model of the zoo was never trained, and an attempt without an end would train for ever.
        "ended_at": run.ended_at or started,
        "outcome": "succeeded",
    }


def _file_row(run_id: str, path: str, file: Any, at: datetime) -> dict[str, Any]:
    return {"run_id": run_id, "path": path, "attempt": ATTEMPT, "created_at": at, **file.model_dump()}


def _points(curves: Curves) -> list[MetricPoint]:
    values: list[dict[str, float]] = [{} for _ in curves.steps]
    for name, curve in curves.metrics.items():
        for place, value in zip(curve.at, curve.values, strict=True):
            values[place][name] = value
    return [MetricPoint(Step(*step), there) for step, there in zip(curves.steps, values, strict=True)]


def _note(content: StudyFile) -> str:
    versions = ", ".join(f"{name} {number}" for name, number in content.versions.items())
    made = f"Imported from a study file made {content.made_at:%Y-%m-%d} on {content.machine}, with {versions}."
    theirs = content.study.note.strip()[: LONGEST_NOTE - len(made) - 2]
    return "\n\n".join(part for part in (theirs, made) if part)


def _free_name(conn: Connection, name: str) -> str:
    """Return the name, with a number if another study has it."""
    taken = set(conn.execute(select(studies.c.name).where(studies.c.deleted_at.is_(None))).scalars())
    names = (name, *(f"{name[: LONGEST_NAME - 6]} ({number})" for number in range(2, len(taken) + 3)))
    return next(free for free in names if free not in taken)
