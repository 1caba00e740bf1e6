"""Whether the service can do its work."""

from __future__ import annotations

from importlib.metadata import version

from fastapi import APIRouter

from backend.api.access.declarations import open_and_shared
from backend.api.dependencies import Store
from backend.api.errors import problem_responses
from backend.api.schemas import Health
from backend.store import viewer_sessions, workers
from backend.store.tables import SCHEMA_REVISION

VERSION = version("sldr")
"""Read from the disk, so once."""

router = APIRouter(tags=["health"])


@router.get("/healthz", responses=problem_responses())
@open_and_shared
def get_health(store: Store) -> Health:
    """Tell whether runs would be trained and watched: the store answers, a worker and the viewer host are alive."""
    known = workers.list_workers(store)
    workers_alive = sum(worker.alive for worker in known)
    viewer_alive = viewer_sessions.is_host_alive(store)
    return Health(
        status="ok" if workers_alive and viewer_alive else "degraded",
        version=VERSION,
        store=store.engine_name,
        schema_revision=SCHEMA_REVISION,
        workers_alive=workers_alive,
        worker_seen_at=max((worker.beat_at for worker in known), default=None),
        viewer_alive=viewer_alive,
    )
