"""The stored files of a run."""

from __future__ import annotations

from fastapi import APIRouter
from fastapi.responses import FileResponse

from backend.api.errors import NotBuilt, problem_responses
from backend.api.schemas import RunFiles

router = APIRouter(prefix="/api/runs/{run_id}/files", tags=["runs"])


@router.get("", responses=problem_responses(404, 422))
def list_run_files(run_id: str) -> RunFiles:
    """List a run's stored files."""
    raise NotBuilt


@router.get(
    "/{name}",
    response_class=FileResponse,
    responses={200: {"content": {"application/octet-stream": {}}}} | problem_responses(404, 416, 422),
)
def download_run_file(run_id: str, name: str) -> FileResponse:
    """Send one stored file, or the range of it that is asked for."""
    raise NotBuilt
