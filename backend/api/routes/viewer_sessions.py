"""3D sessions: asked for here, served by the viewer host, watched through the proxy."""

from __future__ import annotations

from fastapi import APIRouter

from backend.api.access.declarations import needs
from backend.api.answers import has_policy
from backend.api.dependencies import Store, Tokens
from backend.api.errors import ApiError, problem_responses
from backend.api.schemas import ViewerSession
from backend.api.tokens import ViewerTokens
from backend.api.viewer_requests import NEWEST, EpisodeView, InspectorView, LiveView, ViewerRequest
from backend.store import viewer_sessions
from backend.store.database import Database
from backend.store.files import FileRow, list_files
from backend.store.runs import RunRow, get_run
from sldr_core.episodes import episodes_file

POLICY_KINDS = ("policy", "checkpoint", "locomotion")
"""Kinds of files that a policy can be read from."""

router = APIRouter(prefix="/api/viewer-sessions", tags=["viewer sessions"])


@router.post("", status_code=201, responses=problem_responses(400, 403, 404, 409, 422))
@needs("viewer")
def create_viewer_session(request: ViewerRequest, store: Store, tokens: Tokens) -> ViewerSession:
    """Ask the viewer host to show something of a run: see the kinds of views."""
    run = get_run(store, request.run_id)
    files = list_files(store, run.id)
    if isinstance(request, EpisodeView):
        _check_episodes(run, files, request)
    elif isinstance(request, InspectorView):
        _check_model(run, files)
    elif not has_policy(files):
        raise ApiError(409, f"Run {run.id} has no policy to watch yet; wait for its first test.", "run_id")
    if isinstance(request, LiveView):
        _check_policies(store, run, request)
    if not viewer_sessions.is_host_alive(store):
        raise ApiError(503, "The 3D viewer is not running; start it with 'sldr viewer', or wait if it just starts.")
    wish = request.model_dump(exclude={"run_id"})
    return _answer(viewer_sessions.request_session(store, run.id, wish), tokens)


@router.get("/{session_id}", responses=problem_responses(404, 422))
@needs("viewer")
def get_viewer_session(session_id: str, store: Store, tokens: Tokens) -> ViewerSession:
    """Return a session; once it is ready it has the url to open."""
    return _answer(viewer_sessions.get_session(store, session_id), tokens)


@router.delete("/{session_id}", status_code=204, responses=problem_responses(403, 404, 422))
@needs("viewer")
def end_viewer_session(session_id: str, store: Store) -> None:
    """End a session and free what it holds."""
    viewer_sessions.get_session(store, session_id)
    viewer_sessions.mark_ended(store, session_id, message="It was closed.")


def _check_model(run: RunRow, files: list[FileRow]) -> None:
    """Refuse a run that has no locomotion model."""
    if run.phase != "locomotion":
        raise ApiError(409, f"In run {run.id} the robot acts; demonstrations are those of locomotion runs.", "run_id")
    if not any(file.kind == "locomotion" for file in files):
        raise ApiError(409, f"Run {run.id} has no locomotion model yet; wait for its first test.", "run_id")


def _check_episodes(run: RunRow, files: list[FileRow], request: EpisodeView) -> None:
    """Refuse an epoch that was not recorded."""
    if episodes_file(request.epoch) not in {file.name for file in files}:
        raise ApiError(409, f"Run {run.id} has no recorded episodes of epoch {request.epoch}; see its list.", "epoch")


def _check_policies(store: Database, run: RunRow, request: LiveView) -> None:
    """Refuse policies that do not exist, and pairs that cannot start from the same start."""
    _check_policy(store, run.id, request.policy, "policy")
    if request.beside is None:
        return
    if request.episodes > 1:
        raise ApiError(422, "Two policies are compared in one episode each; choose 1.", "episodes")
    other = get_run(store, request.beside.run_id)
    if (other.task, other.phase) != (run.task, run.phase):
        raise ApiError(
            409,
            f"Run {other.id} learns {other.task} ({other.phase}); only policies of {run.task} ({run.phase}) "
            "can start from the same start.",
            "beside.run_id",
        )
    _check_policy(store, other.id, request.beside.policy, "beside.policy")


def _check_policy(store: Database, run_id: str, name: str, field: str) -> None:
    files = list_files(store, run_id)
    if name == NEWEST:
        if not has_policy(files):
            raise ApiError(409, f"Run {run_id} has no policy to watch yet; wait for its first test.", field)
        return
    names = sorted(file.name for file in files if file.kind in POLICY_KINDS)
    if name not in names:
        known = ", ".join([NEWEST, *names])
        raise ApiError(409, f"Run {run_id} has no policy file '{name}'; it has {known}.", field)


def _answer(session: viewer_sessions.Session, tokens: ViewerTokens) -> ViewerSession:
    is_ready = session.state == "ready"
    return ViewerSession(
        id=session.id,
        run_id=session.run_id,
        state=session.state,
        url=f"/viewer/{tokens.sign(session.id, session.created_at)}/" if is_ready else None,
        message=session.message,
    )
