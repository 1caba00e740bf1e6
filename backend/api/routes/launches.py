"""Asking for training: what a launch would queue, and queueing it."""

from __future__ import annotations

from fastapi import APIRouter

from backend.api.access.declarations import needs
from backend.api.answers import run_summary
from backend.api.dependencies import ServiceSettings, Store
from backend.api.errors import problem_responses
from backend.api.schemas import Launch, LaunchPlan, LaunchResult, PlannedRun
from backend.store import launches
from backend.store.runs import get_runs
from backend.store.zoo_runs import ZooShelf
from sldr_core.config import config_to_dict

router = APIRouter(prefix="/api/launches", tags=["launches"])


@router.post("/plan", responses=problem_responses(400, 403, 422))
@needs("viewer")
def plan_launch(launch: Launch, store: Store, settings: ServiceSettings) -> LaunchPlan:
    """Tell what a launch would queue and which existing runs it would share; queue nothing."""
    planned_runs = launches.plan_launch(store, _order(launch), ZooShelf(settings))
    return LaunchPlan(
        runs=[
            PlannedRun(
                task=planned.task,
                phase=planned.phase,
                method=planned.method,
                seed=planned.seed,
                reused_run_id=planned.reused_run_id,
                zoo_success=planned.zoo_success,
                equal_run_id=planned.equal_run_id,
                config=config_to_dict(planned.config),
            )
            for planned in planned_runs
        ]
    )


@router.post("", status_code=201, responses=problem_responses(400, 403, 409, 422))
@needs("operator")
def create_launch(launch: Launch, store: Store, settings: ServiceSettings) -> LaunchResult:
    """Queue a launch's runs, the locomotion run they need first."""
    run_ids = launches.launch(store, _order(launch), ZooShelf(settings))
    return LaunchResult(runs=[run_summary(row) for row in get_runs(store, run_ids)])


def _order(launch: Launch) -> launches.LaunchOrder:
    return launches.LaunchOrder(
        task=launch.task,
        phase=launch.phase,
        method=launch.method,
        seeds=launch.seeds,
        preset=launch.preset,
        overrides=launch.overrides,
        locomotion=launch.locomotion,
    )
