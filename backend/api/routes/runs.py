"""Runs: the table, one run, its curves and its log."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query

from backend.api.errors import NotBuilt, problem_responses
from backend.api.schemas import LogTail, MetricBatch, RunDetail, RunEvents, RunPage
from backend.store.states import RunState
from sldr_core.config import Phase

LARGEST_PAGE = 200
"""Rows in one answer at most."""

router = APIRouter(prefix="/api/runs", tags=["runs"])


@router.get("", responses=problem_responses(422))
def list_runs(
    state: Annotated[list[RunState] | None, Query(description="Only runs in one of these states.")] = None,
    task: str | None = None,
    method: str | None = None,
    phase: Phase | None = None,
    search: Annotated[str | None, Query(max_length=200, description="Part of an id, task or method.")] = None,
    limit: Annotated[int, Query(ge=1, le=LARGEST_PAGE)] = 50,
    cursor: Annotated[str | None, Query(description="`next_cursor` of the page before.")] = None,
) -> RunPage:
    """List runs, newest first, one page at a time."""
    raise NotBuilt


@router.get("/{run_id}", responses=problem_responses(404, 422))
def get_run(run_id: str) -> RunDetail:
    """Return everything about one run but its curves and logs."""
    raise NotBuilt


@router.post("/{run_id}/cancel", responses=problem_responses(404, 409, 422))
def cancel_run(run_id: str) -> RunDetail:
    """End a run for good: at once if it waits, within seconds if it trains."""
    raise NotBuilt


@router.get("/{run_id}/metrics", responses=problem_responses(404, 422))
def get_run_metrics(
    run_id: str, after: Annotated[int, Query(ge=0, description="`cursor` of the answer before.")] = 0
) -> MetricBatch:
    """Return the points of a run after a cursor."""
    raise NotBuilt


@router.get("/{run_id}/log", responses=problem_responses(404, 422))
def get_run_log(
    run_id: str,
    after: Annotated[int | None, Query(ge=0, description="`offset` of the answer before; left out: the end.")] = None,
) -> LogTail:
    """Return the end of a run's log, or what was written after an offset."""
    raise NotBuilt


@router.get("/{run_id}/events", responses=problem_responses(404, 422))
def list_run_events(run_id: str) -> RunEvents:
    """Return a run's history, oldest first."""
    raise NotBuilt
