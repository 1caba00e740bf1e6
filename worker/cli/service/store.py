"""Commands straight on the store, where no service runs; answers are those that the API would give."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict

from pydantic import TypeAdapter

from backend.client.records.runs import PlannedRun, Run, RunDetail, RunPage
from backend.client.records.studies import (
    PlannedLocomotion,
    PlannedPlace,
    StudyEstimate,
    StudyOutcome,
    StudyPreview,
    StudySpec,
)
from backend.comparison.variants import changes
from backend.store import launches, runs
from backend.store.database import Database, open_database
from backend.store.launches import LaunchOrder
from backend.store.run_filter import RunFilter
from backend.store.runs import RunRow
from backend.store.settings import load_settings
from backend.store.states import RunState
from backend.store.studies import launch as study_launch
from backend.store.studies.estimate import estimate_study
from backend.store.studies.matrix import get_study
from backend.store.studies.spec import StudySpec as StoredSpec
from backend.store.studies.spec import Variant
from backend.store.zoo_runs import ZooShelf
from sldr_core.config import config_to_dict
from worker.cli.service import Order, Wanted


@contextmanager
def open_store_service() -> Iterator[StoreService]:
    """Open the store that the environment names.

    Raises:
        SldrError: it cannot be opened.
    """
    settings = load_settings()
    db = open_database(settings)
    try:
        yield StoreService(db, ZooShelf(settings))
    finally:
        db.close()


class StoreService:
    """Ask the store; see `Service`."""

    def __init__(self, db: Database, shelf: ZooShelf | None = None) -> None:
        self._db = db
        self._shelf = shelf

    def plan(self, order: Order) -> list[PlannedRun]:
        """Return what a launch would queue and share, locomotion first."""
        return [_planned(run) for run in launches.plan_launch(self._db, _launch_order(order), self._shelf)]

    def launch(self, order: Order) -> list[Run]:
        """Queue the runs of an order; return them and those that serve, as planned."""
        ids = launches.launch(self._db, _launch_order(order), self._shelf)
        return [run_record(row) for row in runs.get_runs(self._db, ids)]

    def preview_study(self, spec: StudySpec) -> StudyPreview:
        """Return what launching a study would do and cost."""
        plan = study_launch.preview_study(self._db, _stored_spec(spec), shelf=self._shelf)
        return StudyPreview(
            places=[
                PlannedPlace(**asdict(at.place.cell), seed=at.place.seed, standing=at.standing.value, run_id=at.run_id)
                for at in plan.places
            ],
            locomotion=[PlannedLocomotion(run.task, run.reused_run_id, run.zoo_success) for run in plan.locomotion],
            queued=len(plan.new_runs),
            estimate=StudyEstimate(**asdict(estimate_study(self._db, plan))),
        )

    def create_study(self, name: str, spec: StudySpec) -> StudyOutcome:
        """Make a study and queue what nothing serves yet."""
        launched = study_launch.create_study(self._db, name, _stored_spec(spec), shelf=self._shelf)
        return StudyOutcome(launched.study_id, launched.queued, launched.joined)

    def study_run_ids(self, study_id: str) -> list[str]:
        """Return the ids of a study's runs, the locomotion runs that they need first."""
        found = get_study(self._db, study_id)
        return [run.run_id for run in (*found.locomotion, *(run for cell in found.cells for run in cell.runs))]

    def get_run(self, run_id: str) -> RunDetail:
        """Return everything about one run."""
        return run_record(runs.get_run(self._db, run_id))

    def list_runs(self, wanted: Wanted, limit: int) -> RunPage:
        """Return the first runs that are wanted, the newest first."""
        passing = RunFilter(
            states=[RunState(wanted.state)] if wanted.state else (),
            tasks=[wanted.task] if wanted.task else (),
            methods=[wanted.method] if wanted.method else (),
            phases=[wanted.phase] if wanted.phase else (),
            search=wanted.search,
        )
        found = runs.list_runs(self._db, passing, limit)
        return RunPage([run_record(row) for row in found.rows], found.next_cursor, found.total)


def run_record(row: RunRow) -> RunDetail:
    """Return a row of the store as the API would answer it."""
    told = {
        "config": row.config,
        "state": row.state.value,
        "changes": changes(row),
        "locomotion_run_id": row.needs[0] if row.needs else None,
    }
    values = {**asdict(row), **told}
    return _DETAIL.validate_python(values)


def _launch_order(order: Order) -> LaunchOrder:
    return LaunchOrder(
        order.task, order.phase, order.method, order.seeds, order.preset, order.settings, order.locomotion
    )


def _planned(run: launches.PlannedRun) -> PlannedRun:
    return PlannedRun(
        task=run.task,
        phase=run.phase,
        method=run.method,
        seed=run.seed,
        reused_run_id=run.reused_run_id,
        config=config_to_dict(run.config),
        zoo_success=run.zoo_success,
        equal_run_id=run.equal_run_id,
    )


def _stored_spec(spec: StudySpec) -> StoredSpec:
    return StoredSpec(
        tasks=tuple(spec.tasks),
        methods=tuple(spec.methods),
        seeds=tuple(spec.seeds),
        preset=spec.preset,
        overrides=spec.overrides,
        variants=tuple(Variant(variant.name, variant.overrides) for variant in spec.variants),
        locomotion=spec.locomotion,
    )


_DETAIL = TypeAdapter(RunDetail)
