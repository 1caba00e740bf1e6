"""The workers: what they have, what they do, and letting one finish and take no more."""

from __future__ import annotations

from typing import cast

from fastapi import APIRouter

from backend.api.access.declarations import needs
from backend.api.dependencies import Store
from backend.api.errors import problem_responses
from backend.api.queue_schemas import Draining, Worker, WorkerRun, Workers
from backend.store import workers
from backend.store.runs import RunRow, get_runs
from backend.store.workers import WorkerRow
from sldr_core.config import Phase

router = APIRouter(prefix="/api/workers", tags=["workers"])


@router.get("", responses=problem_responses())
@needs("viewer", shared=True)
def list_workers(store: Store) -> Workers:
    """List the workers known to the store, longest serving first."""
    rows = workers.list_workers(store)
    trained = {run.id: run for run in get_runs(store, [run_id for row in rows for run_id in row.running])}
    return Workers(workers=[_worker(row, trained) for row in rows])


@router.put("/{worker_id}/draining", status_code=204, responses=problem_responses(400, 403, 404, 422))
@needs("operator")
def set_worker_draining(worker_id: str, wish: Draining, store: Store) -> None:
    """Let a worker keep what it has and take no further run, or let it take runs again."""
    workers.set_draining(store, worker_id, wish.draining)


def _worker(row: WorkerRow, trained: dict[str, RunRow]) -> Worker:
    return Worker(
        id=row.id,
        host=row.host,
        pid=row.pid,
        executor=row.executor,
        slots=row.slots,
        running=[_worker_run(trained[run_id]) for run_id in row.running if run_id in trained],
        cores=row.cores,
        processor=row.processor,
        gpu=row.gpu,
        memory_total=row.memory_total,
        memory_used=row.memory_used,
        draining=row.draining,
        last_heartbeat_at=row.beat_at,
        alive=row.alive,
    )


def _worker_run(run: RunRow) -> WorkerRun:
    return WorkerRun(id=run.id, task=run.task, phase=cast(Phase, run.phase), method=run.method, seed=run.seed)
