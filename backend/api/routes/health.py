"""Whether the service can do its work."""

from __future__ import annotations

from fastapi import APIRouter

from backend.api.errors import NotBuilt, problem_responses
from backend.api.schemas import Health

router = APIRouter(tags=["health"])


@router.get("/healthz", responses=problem_responses())
def get_health() -> Health:
    """Tell whether runs would be trained and watched: a worker and the viewer host are alive."""
    raise NotBuilt
