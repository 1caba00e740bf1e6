"""What a run wrote: its log and its stored files."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated
from urllib.parse import quote

from fastapi import APIRouter, Header, Query
from fastapi.responses import FileResponse, Response

from backend.api.access.declarations import needs
from backend.api.access.tickets import Tickets
from backend.api.dependencies import ServiceParts, ServiceSettings, Storage, Store
from backend.api.downloads import send_file
from backend.api.errors import problem_responses
from backend.api.routes.runs import LARGEST_CURSOR
from backend.api.schemas import LogTail, RunFile, RunFiles
from backend.store import files, runs
from backend.store.database import Database
from backend.store.errors import NotFound
from backend.store.storage import FileStorage

LOG_PIECE = 64 * 1024
"""Most of a log that one answer holds [bytes]."""

RECORDING_KIND = "recording"
"""Files that Rerun's viewer fetches, which sends no cookie."""

router = APIRouter(prefix="/api/runs/{run_id}", tags=["runs"])


@router.get("/log", responses=problem_responses(404, 422))
@needs("viewer", shared=True)
def get_run_log(
    run_id: str,
    store: Store,
    settings: ServiceSettings,
    storage: Storage,
    after: Annotated[
        int | None,
        Query(ge=0, le=LARGEST_CURSOR, description="`offset` of the answer before; left out: the end of the log."),
    ] = None,
) -> LogTail:
    """Return the end of a run's log, or what was written after an offset."""
    runs.check_run(store, run_id)
    return read_log(_find_log(store, storage, settings.run_directory(run_id) / files.LOG_FILE), after)


@router.get("/files", responses=problem_responses(404, 422))
@needs("viewer")
def list_run_files(run_id: str, service: ServiceParts) -> RunFiles:
    """List a run's stored files."""
    runs.check_run(service.database, run_id)
    rows = files.list_files(service.database, run_id)
    return RunFiles(files=[_run_file(row, service.access.tickets) for row in rows])


@router.get(
    "/files/{name}",
    response_class=FileResponse,
    responses={200: {"content": {"application/octet-stream": {}}}} | problem_responses(404, 416, 422),
)
@needs("viewer")
def download_run_file(
    run_id: str,
    name: str,
    store: Store,
    storage: Storage,
    byte_range: Annotated[str | None, Header(alias="Range", include_in_schema=False)] = None,
) -> Response:
    """Send one stored file, or the range of it that is asked for."""
    runs.check_run(store, run_id)
    return send_file(storage, files.find_file(store, run_id, name), byte_range)


def read_log(path: Path, after: int | None) -> LogTail:
    """Return a piece of a log that may still be growing, cut between characters."""
    if not path.is_file():
        return LogTail(text="", offset=0)
    with path.open("rb") as file:
        size = file.seek(0, 2)
        # An offset beyond the end is of a log that was written anew: begin again at its end.
        start = max(0, size - LOG_PIECE) if after is None or after > size else after
        file.seek(start)
        piece = file.read(LOG_PIECE)
    piece = piece[: _whole_characters(piece)]
    return LogTail(text=piece.decode(errors="replace"), offset=start + len(piece))


def _find_log(store: Database, storage: FileStorage, here: Path) -> Path:
    """Return the path of a run's log: the one that this machine writes, or a copy of another machine's."""
    if storage.shared is None:
        return here
    try:
        row = files.find_file(store, here.parent.name, files.LOG_FILE)
    except NotFound:
        return here
    is_written_here = here.is_file() and here.stat().st_mtime >= row.created_at.timestamp()
    return here if is_written_here else storage.bring(row)


def _whole_characters(piece: bytes) -> int:
    """Return how many bytes of `piece` are left without a UTF-8 character cut off at its end."""
    for back in range(1, min(4, len(piece)) + 1):
        byte = piece[-back]
        if byte < 0x80:
            break
        if byte >= 0xC0:
            length = 2 if byte < 0xE0 else 3 if byte < 0xF0 else 4
            return len(piece) - back if back < length else len(piece)
    return len(piece)


def _run_file(row: files.FileRow, tickets: Tickets) -> RunFile:
    path = f"/api/runs/{row.run_id}/files/{row.name}"
    return RunFile(
        name=row.name,
        kind=row.kind,
        size=row.size,
        sha256=row.sha256,
        created_at=row.created_at,
        url=f"/api/runs/{row.run_id}/files/{quote(row.name, safe='')}",
        ticket=tickets.sign(path, datetime.now(UTC)) if row.kind == RECORDING_KIND else None,
    )
