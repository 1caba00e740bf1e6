"""Comparisons of runs over seeds: curves, best models, configs."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query

from backend.api.access.declarations import needs
from backend.api.compare_questions import Choice, View
from backend.api.dependencies import Memory, Store
from backend.api.errors import problem_responses
from backend.comparison.best import compare_best
from backend.comparison.configs import compare_configs
from backend.comparison.curves import compare_curves
from backend.comparison.records import BestModels, ConfigComparison, CurveComparison, MetricNames
from backend.comparison.selection import select_runs
from backend.store.curves import list_metric_names

CONFIGS_AT_MOST = 50
"""Runs whose configs are compared at once."""

router = APIRouter(prefix="/api/compare", tags=["compare"])


@router.get("", responses=problem_responses(404, 422))
@needs("viewer", shared=True)
def get_curves(choice: Choice, view: View, store: Store, memory: Memory) -> CurveComparison:
    """Return learning curves, one panel a task, one curve a group of seeds."""
    return compare_curves(store, memory, choice, view)


@router.get("/best", responses=problem_responses(404, 422))
@needs("viewer", shared=True)
def get_best_models(choice: Choice, view: View, store: Store, memory: Memory) -> BestModels:
    """Compare best test success: bars, improvement, profile and efficiency. Of the view, statistic and level count."""
    return compare_best(store, memory, choice, view)


@router.get("/metrics", responses=problem_responses(404, 422))
@needs("viewer", shared=True)
def list_compared_metrics(choice: Choice, store: Store, memory: Memory) -> MetricNames:
    """List the metrics that runs have logged."""
    return MetricNames(metrics=list_metric_names(store, select_runs(store, memory, choice).runs))


@router.get("/configs", responses=problem_responses(404, 422))
@needs("viewer", shared=True)
def get_config_comparison(
    run: Annotated[list[str], Query(min_length=1, max_length=CONFIGS_AT_MOST, description="Ids of runs.")], store: Store
) -> ConfigComparison:
    """Return the settings in which runs differ, and the switches between their methods."""
    return compare_configs(store, run)
