"""Whether the service can do its work."""

from __future__ import annotations

from importlib.metadata import version

from fastapi import APIRouter

from backend.api.access.declarations import open_to_all
from backend.api.dependencies import Store
from backend.api.errors import problem_responses
from backend.api.schemas import Health
from backend.store import viewer_sessions, workers

router = APIRouter(tags=["health"])


@router.get("/healthz", responses=problem_responses())
@open_to_all
def get_health(store: Store) -> Health:
    """Tell whether runs would be trained and watched: a worker and the viewer host are alive."""
    workers_alive = sum(worker.alive for worker in workers.list_workers(store))
    viewer_alive = viewer_sessions.is_host_alive(store)
    status = "ok" if workers_alive and viewer_alive else "degraded"
    return Health(status=status, version=version("sldr"), workers_alive=workers_alive, viewer_alive=viewer_alive)
