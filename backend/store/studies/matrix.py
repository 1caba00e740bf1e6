"""Reading studies: the list, and one as a matrix of cells with the runs of their seeds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from statistics import fmean, median
from typing import Any

from sqlalchemy import ColumnElement, Connection, Select, case, func, select

from backend.store.database import Database
from backend.store.states import RunState
from backend.store.studies.launch import find_study
from backend.store.studies.spec import Cell, Place, StudySpec, spec_from_dict
from backend.store.tables import AnyRow, run_needs, run_progress, runs, studies, study_runs


@dataclass(frozen=True)
class StudyRow:
    """Describe one study."""

    id: str
    name: str
    note: str
    spec: StudySpec
    created_at: datetime
    deleted_at: datetime | None
    """When a person hid it."""
    states: Mapping[RunState, int]
    """How many of its runs are in each state; locomotion runs are not counted."""
    progress: float
    """Share of all its trainings done, 0 to 1; a place without a run counts as nothing done."""


@dataclass(frozen=True)
class StudyRun:
    """Say how one run of a study stands."""

    run_id: str
    task: str
    seed: int
    state: RunState
    reason: str | None
    """Why it waits or ended so, in one sentence."""
    progress: float
    """Share of its training done, 0 to 1."""
    best_success_rate: float | None
    """Success of its best test."""


@dataclass(frozen=True)
class MatrixCell:
    """Hold the runs of one task, method and variant, one for each seed that has one."""

    cell: Cell
    runs: tuple[StudyRun, ...]
    missing_seeds: tuple[int, ...]
    """Seeds of the study that no run stands for."""

    @property
    def states(self) -> Mapping[RunState, int]:
        """How many runs are in each state."""
        return Counter(run.state for run in self.runs)

    @property
    def progress(self) -> float:
        """Share of its trainings done, 0 to 1."""
        return fmean([run.progress for run in self.runs] + [0.0] * len(self.missing_seeds))

    @property
    def tested(self) -> int:
        """How many runs have been tested."""
        return sum(run.best_success_rate is not None for run in self.runs)

    @property
    def best_success_rate(self) -> float | None:
        """Median, over the seeds that have been tested, of the success of the best test."""
        rates = [run.best_success_rate for run in self.runs if run.best_success_rate is not None]
        return median(rates) if rates else None


@dataclass(frozen=True)
class StudyMatrix:
    """Hold a study with all its cells."""

    study: StudyRow
    cells: list[MatrixCell]
    """Every cell, task by task."""
    locomotion: list[StudyRun]
    """The locomotion runs that its runs need, each once."""


def list_studies(db: Database, limit: int, deleted: bool = False) -> list[StudyRow]:
    """Return the newest studies, or the newest of those that a person hid."""
    hidden = studies.c.deleted_at.is_not(None)
    query = select(studies).where(hidden if deleted else ~hidden).order_by(studies.c.number.desc()).limit(limit)
    with db.read() as conn:
        rows = conn.execute(query).all()
        tallies = _tally(conn, [row.id for row in rows])
    return [_study_row(row, tallies.get(row.id, [])) for row in rows]


def get_study(db: Database, study_id: str) -> StudyMatrix:
    """Return a study, deleted or not, with the runs of all its cells.

    Raises:
        NotFound: there is no such study.
    """
    with db.read() as conn:
        row = find_study(conn, study_id)
        tally = _tally(conn, [study_id]).get(study_id, [])
        members = _select_members(conn, study_id)
        locomotion = [_study_run(needed) for needed in conn.execute(_needed_by(study_id))]
    study = _study_row(row, tally)
    return StudyMatrix(study, [_cell(cell, study.spec.seeds, members) for cell in study.spec.cells], locomotion)


def study_run_ids(db: Database, study_id: str) -> list[str]:
    """Return the ids of a study's runs that are not deleted, locomotion runs left out, in the order of their launch.

    Raises:
        NotFound: there is no such study.
    """
    query = select(runs.c.id).join(study_runs, study_runs.c.run_id == runs.c.id)
    with db.read() as conn:
        find_study(conn, study_id)
        there = (study_runs.c.study_id == study_id, runs.c.deleted_at.is_(None))
        return list(conn.execute(query.where(*there).order_by(runs.c.number)).scalars())


_DONE: ColumnElement[float] = case(
    (runs.c.state == RunState.SUCCEEDED, 1.0), else_=func.coalesce(run_progress.c.fraction, 0.0)
)
"""Share of a run's training done; one that ended early because it had learnt enough is done."""

_STANDING = (
    runs.c.id,
    runs.c.task,
    runs.c.seed,
    runs.c.state,
    runs.c.reason,
    _DONE.label("progress"),
    run_progress.c.best_success_rate,
)
"""What is told of each run of a study."""


def _tally(conn: Connection, study_ids: Sequence[str]) -> dict[str, list[AnyRow]]:
    """Count the runs of studies by state, and add up what is done of them."""
    query = (
        select(
            study_runs.c.study_id,
            runs.c.state,
            func.count().label("run_count"),
            func.sum(_DONE).label("done"),
        )
        .join(runs, runs.c.id == study_runs.c.run_id)
        .outerjoin(run_progress, run_progress.c.run_id == runs.c.id)
        .where(study_runs.c.study_id.in_(study_ids), runs.c.deleted_at.is_(None))
        .group_by(study_runs.c.study_id, runs.c.state)
    )
    tallies: dict[str, list[AnyRow]] = {}
    for row in conn.execute(query):
        tallies.setdefault(row.study_id, []).append(row)
    return tallies


def _select_members(conn: Connection, study_id: str) -> dict[Place, StudyRun]:
    query = (
        select(*_STANDING, study_runs.c.method.label("cell_method"), study_runs.c.variant)
        .join(study_runs, study_runs.c.run_id == runs.c.id)
        .outerjoin(run_progress, run_progress.c.run_id == runs.c.id)
        .where(study_runs.c.study_id == study_id, runs.c.deleted_at.is_(None))
    )
    return {
        Place(Cell(row.task, row.cell_method, row.variant), row.seed): _study_run(row) for row in conn.execute(query)
    }


def _needed_by(study_id: str) -> Select[*tuple[Any, ...]]:
    """Ask for the locomotion runs that runs of a study need."""
    needed = (
        select(run_needs.c.needs_run_id)
        .join(study_runs, study_runs.c.run_id == run_needs.c.run_id)
        .where(study_runs.c.study_id == study_id)
    )
    query = select(*_STANDING).outerjoin(run_progress, run_progress.c.run_id == runs.c.id)
    return query.where(runs.c.id.in_(needed), runs.c.deleted_at.is_(None)).order_by(runs.c.number)


def _study_row(row: AnyRow, tally: Iterable[AnyRow]) -> StudyRow:
    spec = spec_from_dict(row.spec)
    counted = list(tally)
    return StudyRow(
        id=row.id,
        name=row.name,
        note=row.note,
        spec=spec,
        created_at=row.created_at,
        deleted_at=row.deleted_at,
        states={RunState(state.state): state.run_count for state in counted},
        progress=sum(state.done for state in counted) / spec.size,
    )


def _study_run(row: AnyRow) -> StudyRun:
    return StudyRun(
        run_id=row.id,
        task=row.task,
        seed=row.seed,
        state=RunState(row.state),
        reason=row.reason,
        progress=row.progress,
        best_success_rate=row.best_success_rate,
    )


def _cell(cell: Cell, seeds: Sequence[int], members: Mapping[Place, StudyRun]) -> MatrixCell:
    places = [Place(cell, seed) for seed in sorted(seeds)]
    return MatrixCell(
        cell=cell,
        runs=tuple(members[place] for place in places if place in members),
        missing_seeds=tuple(place.seed for place in places if place not in members),
    )
