"""Thumbnails and videos of runs: ordered here, drawn by the viewer host when there is time."""

from __future__ import annotations

from pathlib import PurePath
from urllib.parse import quote

from fastapi import APIRouter
from fastapi.responses import FileResponse, RedirectResponse, Response

from backend.api.access.declarations import needs
from backend.api.dependencies import ServiceSettings, Storage, Store
from backend.api.downloads import send_file
from backend.api.errors import ApiError, problem_responses
from backend.api.media_schemas import Video, VideoOrder, Videos
from backend.store import files, media_jobs, runs
from backend.store.database import Database
from backend.store.errors import NotFound
from backend.store.media_jobs import MediaJob, MediaOrder
from backend.store.thumbnails import THUMBNAIL_FILE
from sldr_core.episodes import episodes_file

NEWEST_POLICY = "policy-newest.pt"
"""What makes an episode where none is named."""

router = APIRouter(prefix="/api/runs/{run_id}", tags=["media"])


@router.get(
    "/thumbnail",
    response_class=FileResponse,
    responses={
        200: {"content": {"image/webp": {}}},
        307: {"description": "There is none yet; the picture of its task stands in for it."},
    }
    | problem_responses(404, 422),
)
@needs("viewer")
def get_run_thumbnail(run_id: str, store: Store, storage: Storage, settings: ServiceSettings) -> Response:
    """Send the end of an episode of a run's newest policy, as a small picture."""
    run = runs.get_run(store, run_id)
    try:
        return send_file(storage, files.find_file(store, run_id, THUMBNAIL_FILE), None)
    except (NotFound, ApiError):
        if not (settings.pictures_directory / f"{run.task}.png").is_file():
            raise ApiError(404, f"There is no picture of run {run_id} yet; the viewer draws one.") from None
        return RedirectResponse(f"/api/tasks/{run.task}/thumbnail")


@router.post("/videos", status_code=202, responses=problem_responses(400, 403, 404, 409, 422))
@needs("operator")
def order_video(run_id: str, order: VideoOrder, store: Store) -> Video:
    """Order a video of an episode; one that is there or on its way is not made again, one that failed is."""
    runs.check_run(store, run_id)
    source = _find_source(store, run_id, order)
    wanted = order.model_dump()
    what = "newest-policy" if order.epoch is None else f"epoch-{order.epoch:04d}"
    name = f"video-{what}-episode-{order.number}-{order.width}x{order.height}.{wanted.pop('format')}"
    arguments = {**wanted, "file": source.name}
    return _answer(media_jobs.order_media(store, MediaOrder(run_id, "video", source.sha256, name, arguments)))


@router.get("/videos", responses=problem_responses(404, 422))
@needs("viewer")
def list_videos(run_id: str, store: Store) -> Videos:
    """List the videos of a run that were ordered, the newest first."""
    runs.check_run(store, run_id)
    return Videos(videos=[_answer(job) for job in media_jobs.list_media(store, run_id, "video")])


def _find_source(store: Database, run_id: str, order: VideoOrder) -> files.FileRow:
    rows = {row.name: row for row in files.list_files(store, run_id)}
    if order.epoch is None:
        if NEWEST_POLICY not in rows:
            raise ApiError(409, f"Run {run_id} has no policy to film yet; wait for its first test.")
        return rows[NEWEST_POLICY]
    name = episodes_file(order.epoch)
    if name not in rows:
        there = ", ".join(found for found in rows if PurePath(found).suffix == PurePath(name).suffix) or "none"
        raise ApiError(404, f"Run {run_id} has no file {name}; of recorded episodes there are: {there}.", "epoch")
    return rows[name]


def _answer(job: MediaJob) -> Video:
    is_done = job.state == "done"
    return Video(
        id=job.id,
        run_id=job.run_id,
        epoch=job.arguments["epoch"],
        number=job.arguments["number"],
        width=job.arguments["width"],
        height=job.arguments["height"],
        name=job.file_name,
        state=job.state,
        reason=job.reason,
        url=f"/api/runs/{job.run_id}/files/{quote(job.file_name, safe='')}" if is_done else None,
        created_at=job.created_at,
    )
