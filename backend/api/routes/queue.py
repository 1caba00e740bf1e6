"""The queue: in which order runs will start, what each waits for, and when."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query

from backend.api.access.declarations import needs
from backend.api.answers import run_summary
from backend.api.dependencies import Store
from backend.api.errors import problem_responses
from backend.api.queue_schemas import Queue, QueueEntry
from backend.store import forecast

LARGEST_QUEUE = 1000
"""Runs in one answer at most."""

router = APIRouter(prefix="/api/queue", tags=["queue"])


@router.get("", responses=problem_responses(422))
@needs("viewer", shared=True)
def get_queue(store: Store, limit: Annotated[int, Query(ge=1, le=LARGEST_QUEUE)] = 200) -> Queue:
    """List the first of the runs that have not ended, in the order in which they will start."""
    entries = forecast.list_queue(store)
    return Queue(
        entries=[
            QueueEntry(
                run=run_summary(entry.run),
                position=entry.position,
                waits_for=entry.waits_for,
                starts_at=entry.starts_at,
                ends_at=entry.ends_at,
            )
            for entry in entries[:limit]
        ],
        total=len(entries),
    )
