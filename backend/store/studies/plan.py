"""What launching a study would do: which places have a run, which are served by one from elsewhere, which need one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from sqlalchemy import Connection, select

from backend.store.locomotion import LocomotionWish
from backend.store.run_plans import PlannedRun, plan_runs
from backend.store.studies.spec import Cell, Place, StudySpec, check_spec, check_variants_differ, make_configs
from backend.store.tables import runs, study_runs
from backend.store.zoo_runs import ZooShelf
from sldr_core.config import config_hash


class Standing(StrEnum):
    """How a place of a study comes to its run."""

    NEW = "new"
    """A run is made."""
    JOINED = "joined"
    """A run that exists elsewhere serves."""
    IN_STUDY = "in_study"
    """The study has its run already."""


@dataclass(frozen=True)
class PlannedPlace:
    """Say which run stands at a place, or will."""

    place: Place
    standing: Standing
    run_id: str | None
    """The existing run; None for a new one."""
    config_hash: str | None
    """What makes two runs the same training; None for a place that has its run."""


@dataclass(frozen=True)
class StudyPlan:
    """Hold all that launching a study would do."""

    spec: StudySpec
    places: list[PlannedPlace]
    runs: list[PlannedRun]
    """The runs of all places that have none yet, behind the locomotion runs that those need."""

    @property
    def new_runs(self) -> list[PlannedRun]:
        """The runs that would be queued; those of the zoo's models have been trained already."""
        return [run for run in self.runs if run.reused_run_id is None and run.model is None]

    @property
    def locomotion(self) -> list[PlannedRun]:
        """The locomotion runs that new runs need, made or reused."""
        return [run for run in self.runs if run.phase == "locomotion"]


def plan_study(
    conn: Connection, spec: StudySpec, study_id: str | None = None, shelf: ZooShelf | None = None
) -> StudyPlan:
    """Return what launching a spec would do, for a new study or for one that is there.

    Raises:
        UnknownName: task, method or preset does not exist.
        InvalidConfig: the study, or a setting of one of its runs, cannot work.
    """
    check_spec(spec)
    members: Mapping[Place, str] = {} if study_id is None else find_members(conn, study_id)
    if members:  # their configs are not made below, where all are looked at
        check_variants_differ(spec)
    configs = make_configs(spec, [place for place in spec.places if place not in members])
    wish = LocomotionWish(spec.locomotion, shelf)
    planned = plan_runs(conn, list(configs.values()), spec.preset, share_all=True, wish=wish)
    by_hash = {run.config_hash: run for run in planned}
    digests = {place: config_hash(config) for place, config in configs.items()}
    places = [
        PlannedPlace(place, Standing.IN_STUDY, members[place], None)
        if place in members
        else _planned_place(place, by_hash[digests[place]])
        for place in spec.places
    ]
    return StudyPlan(spec, places, planned)


def find_members(conn: Connection, study_id: str) -> Mapping[Place, str]:
    """Return the ids of a study's runs by their place; a deleted run leaves its place empty."""
    query = (
        select(study_runs)
        .join(runs, runs.c.id == study_runs.c.run_id)
        .where(study_runs.c.study_id == study_id, runs.c.deleted_at.is_(None))
    )
    return {Place(Cell(row.task, row.method, row.variant), row.seed): row.run_id for row in conn.execute(query)}


def _planned_place(place: Place, run: PlannedRun) -> PlannedPlace:
    standing = Standing.NEW if run.reused_run_id is None else Standing.JOINED
    return PlannedPlace(place, standing, run.reused_run_id, run.config_hash)
