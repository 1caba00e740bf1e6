"""One run: what it is, its history, its attempts and its curves."""

from __future__ import annotations

from dataclasses import asdict
from typing import Annotated

from fastapi import APIRouter, Query

from backend.api.access.declarations import needs
from backend.api.answers import run_detail
from backend.api.dependencies import Store
from backend.api.errors import problem_responses
from backend.api.queue_schemas import Attempt, Attempts
from backend.api.schemas import MetricBatch, RunDetail, RunEvent, RunEvents
from backend.store import attempts, files, metrics, runs

LARGEST_CURSOR = 2**53 - 1
"""Cursors are numbers that JavaScript holds exactly."""

router = APIRouter(prefix="/api/runs", tags=["runs"])


@router.get("/{run_id}", responses=problem_responses(404, 422))
@needs("viewer", shared=True)
def get_run(run_id: str, store: Store) -> RunDetail:
    """Return everything about one run but its curves and logs."""
    return run_detail(runs.get_run(store, run_id), files.list_files(store, run_id))


@router.get("/{run_id}/metrics", responses=problem_responses(404, 422))
@needs("viewer", shared=True)
def get_run_metrics(
    run_id: str,
    store: Store,
    after: Annotated[int, Query(ge=0, le=LARGEST_CURSOR, description="`cursor` of the answer before.")] = 0,
    superseded: Annotated[bool, Query(description="Whether to add the points that a later attempt replaced.")] = False,
) -> MetricBatch:
    """Return the points of a run after a cursor, oldest first; ask again until there are none."""
    runs.check_run(store, run_id)
    return MetricBatch(**asdict(metrics.read_metrics(store, run_id, after, superseded=superseded)))


@router.get("/{run_id}/attempts", responses=problem_responses(404, 422))
@needs("viewer", shared=True)
def list_run_attempts(run_id: str, store: Store) -> Attempts:
    """Return a run's attempts, oldest first."""
    return Attempts(
        attempts=[
            Attempt(
                attempt=row.attempt,
                worker_id=row.worker_id,
                host=row.host,
                started_at=row.started_at,
                ended_at=row.ended_at,
                outcome=row.outcome,
                reason=row.reason,
                first_cycle=row.first_cycle,
            )
            for row in attempts.list_attempts(store, run_id)
        ]
    )


@router.get("/{run_id}/events", responses=problem_responses(404, 422))
@needs("viewer", shared=True)
def list_run_events(run_id: str, store: Store) -> RunEvents:
    """Return a run's history, oldest first."""
    rows = runs.list_events(store, run_id)
    return RunEvents(
        events=[
            RunEvent(at=row.at, event=row.event, state=row.state, attempt=row.attempt, detail=row.detail)
            for row in rows
        ]
    )
