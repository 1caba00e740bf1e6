"""The workers and what they do."""

from __future__ import annotations

from fastapi import APIRouter

from backend.api.errors import NotBuilt, problem_responses
from backend.api.schemas import Workers

router = APIRouter(prefix="/api/workers", tags=["workers"])


@router.get("", responses=problem_responses())
def list_workers() -> Workers:
    """List the workers known to the store."""
    raise NotBuilt
