"""The workers and what they do."""

from __future__ import annotations

from fastapi import APIRouter

from backend.api.dependencies import Store
from backend.api.errors import problem_responses
from backend.api.schemas import Worker, Workers
from backend.store import workers

router = APIRouter(prefix="/api/workers", tags=["workers"])


@router.get("", responses=problem_responses())
def list_workers(store: Store) -> Workers:
    """List the workers known to the store."""
    return Workers(
        workers=[
            Worker(
                id=row.id,
                host=row.host,
                pid=row.pid,
                slots=row.slots,
                busy=row.busy,
                last_heartbeat_at=row.beat_at,
                alive=row.alive,
            )
            for row in workers.list_workers(store)
        ]
    )
