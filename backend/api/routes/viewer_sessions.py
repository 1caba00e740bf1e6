"""3D sessions: asked for here, served by the viewer host, watched through the proxy."""

from __future__ import annotations

from fastapi import APIRouter

from backend.api.errors import NotBuilt, problem_responses
from backend.api.schemas import ViewerRequest, ViewerSession

router = APIRouter(prefix="/api/viewer-sessions", tags=["viewer sessions"])


@router.post("", status_code=201, responses=problem_responses(404, 409, 422))
def create_viewer_session(request: ViewerRequest) -> ViewerSession:
    """Ask the viewer host to show the newest policy of a run."""
    raise NotBuilt


@router.get("/{session_id}", responses=problem_responses(404, 422))
def get_viewer_session(session_id: str) -> ViewerSession:
    """Return a session; once it is ready it has the url to open."""
    raise NotBuilt


@router.delete("/{session_id}", status_code=204, responses=problem_responses(404, 422))
def end_viewer_session(session_id: str) -> None:
    """End a session and free what it holds."""
    raise NotBuilt
