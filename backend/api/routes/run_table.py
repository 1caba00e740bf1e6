"""The runs table: pages of runs with the metrics asked for, groups of runs, and both as CSV."""

from __future__ import annotations

from dataclasses import asdict
from typing import Annotated, Any

from fastapi import APIRouter, Query
from fastapi.responses import Response

from backend.api.access.declarations import needs
from backend.api.answers import run_summary
from backend.api.dependencies import Store
from backend.api.errors import problem_responses
from backend.api.run_csv import write_groups, write_runs
from backend.api.run_query import WantedRuns, WantedTable
from backend.api.schemas import RunPage
from backend.api.table_schemas import MetricNames, RunGroup, RunGroups, Spread
from backend.store import run_groups, runs
from backend.store.metric_columns import parse_column
from backend.store.metric_summaries import list_metric_names
from backend.store.run_groups import GroupKey, GroupSort
from backend.store.tables import NAME_LENGTH

LARGEST_PAGE = 200
"""Rows in one answer at most."""
LARGEST_OFFSET = 1_000_000
"""A table is not longer."""
LARGEST_CSV = 20_000
"""Rows of one CSV file at most."""

router = APIRouter(prefix="/api", tags=["runs"])

By = Annotated[
    list[GroupKey],
    Query(min_length=1, max_length=6, description="What the runs of a group share; `settings` is all but the seed."),
]
Spreading = Annotated[
    str, Query(max_length=NAME_LENGTH, description="Metric whose spread is wanted, written as a column.")
]
CSV: dict[int | str, dict[str, Any]] = {200: {"content": {"text/csv": {}}, "description": "One row a run or group."}}


@router.get("/runs", responses=problem_responses(422))
@needs("viewer", shared=True)
def list_runs(
    store: Store,
    wanted: WantedRuns,
    table: WantedTable,
    limit: Annotated[int, Query(ge=1, le=LARGEST_PAGE)] = 50,
    cursor: Annotated[
        str | None, Query(max_length=15, description="`next_cursor` of the page before, to read on while runs change.")
    ] = None,
    offset: Annotated[
        int, Query(ge=0, le=LARGEST_OFFSET, description="Runs to leave out, to jump into a long table.")
    ] = 0,
) -> RunPage:
    """List runs, one page at a time; the newest come first unless another order is asked for."""
    found = runs.list_runs(store, wanted.filter(), limit, cursor, table.order(), table.columns(), offset)
    return RunPage(
        runs=[run_summary(row) for row in found.rows],
        values=[list(values) for values in found.values],
        next_cursor=found.next_cursor,
        total=found.total,
    )


@router.get("/runs.csv", response_class=Response, responses=CSV | problem_responses(422))
@needs("viewer")
def download_runs(store: Store, wanted: WantedRuns, table: WantedTable) -> Response:
    """Send the table as CSV, in its order and with its columns."""
    columns = table.columns()
    found = runs.list_runs(store, wanted.filter(), LARGEST_CSV, None, table.order(), columns)
    return _csv(write_runs(found, columns), "runs.csv")


@router.get("/run-groups", responses=problem_responses(422))
@needs("viewer", shared=True)
def list_run_groups(
    store: Store,
    wanted: WantedRuns,
    by: By,
    metric: Spreading = "test/success_rate:last",
    sort: GroupSort = "launched",
    descending: bool = True,
) -> RunGroups:
    """List the groups of the runs that pass the filters, with the quartiles of one metric over their runs."""
    found = run_groups.group_runs(store, wanted.filter(), by, parse_column(metric, "metric"), sort, descending)
    return RunGroups(groups=[_group(group) for group in found], total=sum(group.runs for group in found))


@router.get("/run-groups.csv", response_class=Response, responses=CSV | problem_responses(422))
@needs("viewer")
def download_run_groups(
    store: Store,
    wanted: WantedRuns,
    by: By,
    metric: Spreading = "test/success_rate:last",
    sort: GroupSort = "launched",
    descending: bool = True,
) -> Response:
    """Send the groups as CSV, in their order."""
    column = parse_column(metric, "metric")
    found = run_groups.group_runs(store, wanted.filter(), by, column, sort, descending)
    return _csv(write_groups(found, by, column), "run-groups.csv")


@router.get("/metric-names", responses=problem_responses())
@needs("viewer", shared=True)
def list_metrics(store: Store) -> MetricNames:
    """List what runs have logged."""
    return MetricNames(names=list_metric_names(store))


def _group(group: run_groups.RunGroup) -> RunGroup:
    return RunGroup(
        keys={str(key): value for key, value in group.keys.items()},
        runs=group.runs,
        seeds=list(group.seeds),
        states=dict(group.states),
        spread=None if group.spread is None else Spread(**asdict(group.spread)),
    )


def _csv(text: str, name: str) -> Response:
    headers = {"Content-Disposition": f'attachment; filename="{name}"'}
    return Response(text, media_type="text/csv", headers=headers)
