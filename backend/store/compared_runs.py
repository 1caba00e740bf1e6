"""Which runs a comparison is about, and how far each had come when it was asked."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from sqlalchemy import ColumnElement, Connection, func, or_, select

from backend.store.database import Database
from backend.store.errors import NotFound
from backend.store.states import RunState
from backend.store.tables import AnyRow, metric_steps, run_needs, runs, studies, study_runs
from sldr_core.config import Phase

RUNS_AT_MOST = 2000
"""Runs that one comparison reads; of more, the newest."""


@dataclass(frozen=True)
class RunChoice:
    """Say which runs are compared: those that pass every question that is asked. Runs that a person hid never are."""

    phase: Phase | None = "manipulation"
    """None: both."""
    tasks: Sequence[str] = ()
    """Any, if none is named; the same holds for the others."""
    methods: Sequence[str] = ()
    presets: Sequence[str] = ()
    run_ids: Sequence[str] = ()
    study_id: str | None = None
    """Only runs of this study, or the locomotion runs that they need."""


@dataclass(frozen=True)
class ComparedRun:
    """Describe one run of a comparison."""

    id: str
    number: int
    """Counts up with every launched run."""
    task: str
    phase: str
    method: str
    seed: int
    preset: str
    attempt: int
    config_hash: str
    state: RunState
    newest_step_id: int
    """The id of its newest point of metrics; 0 if it has none. What it has logged does not change without this."""
    needs: tuple[str, ...] = ()
    """Ids of the locomotion runs that it learns from, deleted ones among them."""


@dataclass(frozen=True)
class ComparedRuns:
    """Hold the runs of a comparison, oldest first."""

    runs: list[ComparedRun]
    total: int
    """Runs that pass, among them those beyond `RUNS_AT_MOST`."""


def find_compared_runs(db: Database, choice: RunChoice) -> ComparedRuns:
    """Return the runs that a comparison is about.

    Raises:
        NotFound: there is no such study.
    """
    conditions = _conditions(choice)
    newest = (
        select(func.max(metric_steps.c.id))
        .where(metric_steps.c.run_id == runs.c.id)
        .correlate(runs)
        .scalar_subquery()
        .label("newest_step_id")
    )
    columns = [runs.c[name] for name in _COLUMNS]
    query = select(*columns, newest).where(*conditions).order_by(runs.c.number.desc()).limit(RUNS_AT_MOST)
    with db.read() as conn:
        _check_study(conn, choice.study_id)
        rows = conn.execute(query).all()
        total = len(rows) if len(rows) < RUNS_AT_MOST else _count(conn, conditions)
        needs = _read_needs(conn, [row.id for row in rows])
    return ComparedRuns([_compared_run(row, needs.get(row.id, ())) for row in reversed(rows)], total)


def read_configs(db: Database, run_ids: Sequence[str]) -> dict[str, dict[str, Any]]:
    """Return the configs of runs by run id, leaving out runs that do not exist."""
    with db.read() as conn:
        query = select(runs.c.id, runs.c.config).where(runs.c.id.in_(run_ids))
        return {row.id: row.config for row in conn.execute(query)}


_COLUMNS = ("id", "number", "task", "phase", "method", "seed", "preset", "attempt", "config_hash", "state")


def _compared_run(row: AnyRow, needs: Sequence[str]) -> ComparedRun:
    *columns, state, newest = row
    return ComparedRun(*columns, state=RunState(state), newest_step_id=newest or 0, needs=tuple(needs))


def _read_needs(conn: Connection, run_ids: Sequence[str]) -> dict[str, list[str]]:
    needs: dict[str, list[str]] = {}
    for run_id, needed in conn.execute(select(run_needs).where(run_needs.c.run_id.in_(run_ids))):
        needs.setdefault(run_id, []).append(needed)
    return needs


def _conditions(choice: RunChoice) -> list[ColumnElement[bool]]:
    asked = {"task": choice.tasks, "method": choice.methods, "preset": choice.presets, "id": choice.run_ids}
    conditions: list[ColumnElement[bool]] = [runs.c[name].in_(list(names)) for name, names in asked.items() if names]
    if choice.phase is not None:
        conditions.append(runs.c.phase == choice.phase)
    if choice.study_id is not None:
        conditions.append(_is_of_study(choice.study_id))
    return [*conditions, runs.c.deleted_at.is_(None)]


def _is_of_study(study_id: str) -> ColumnElement[bool]:
    members = select(study_runs.c.run_id).where(study_runs.c.study_id == study_id)
    needed = select(run_needs.c.needs_run_id).where(run_needs.c.run_id.in_(members))
    return or_(runs.c.id.in_(members), runs.c.id.in_(needed))


def _check_study(conn: Connection, study_id: str | None) -> None:
    if study_id is None:
        return
    query = select(studies.c.id).where(studies.c.id == study_id, studies.c.deleted_at.is_(None))
    if conn.execute(query).one_or_none() is None:
        raise NotFound("study", study_id)


def _count(conn: Connection, conditions: Sequence[ColumnElement[bool]]) -> int:
    return conn.execute(select(func.count()).select_from(runs).where(*conditions)).scalar_one()
