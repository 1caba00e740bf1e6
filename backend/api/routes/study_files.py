"""Studies as files: taking one along, taking one in, and opening those that come with the product."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any, BinaryIO

from fastapi import APIRouter, Request
from fastapi.responses import FileResponse
from pydantic import Field
from starlette.concurrency import run_in_threadpool
from starlette.types import Receive, Scope, Send

from backend.api.access.declarations import needs
from backend.api.dependencies import ServiceSettings, Store
from backend.api.errors import ApiError, problem_responses
from backend.api.schemas import Strict
from backend.samples import sample_studies
from backend.store.full_disk import explain_no_room
from backend.store.study_files.packing import pack_study
from backend.store.study_files.placing import LARGEST_STUDY_FILE, Imported, import_study

router = APIRouter(prefix="/api/study-files", tags=["studies"])

ARCHIVE = "application/zip"
UPLOAD: dict[str, Any] = {
    "requestBody": {
        "required": True,
        "description": "A study file, as it was exported.",
        "content": {ARCHIVE: {"schema": {"type": "string", "format": "binary"}}},
    }
}
DOWNLOAD: dict[int | str, dict[str, Any]] = {
    200: {"content": {ARCHIVE: {"schema": {"type": "string", "format": "binary"}}}, "description": "The study file."}
}


class StudyImport(Strict):
    """What taking in a study file has done."""

    study_id: str
    runs: int
    already_there: bool


class SampleStudies(Strict):
    """The studies with real results that come with the product."""

    files: int
    size: int = Field(description="Of all files together, in bytes.")


class SampleImport(Strict):
    """What opening the sample studies has done."""

    studies: list[StudyImport]


@router.get("/sample", responses=problem_responses())
@needs("viewer")
def get_sample_studies() -> SampleStudies:
    """Tell how many sample studies come with the product, and how large their files are."""
    sizes = [path.stat().st_size for path in sample_studies()]
    return SampleStudies(files=len(sizes), size=sum(sizes))


@router.post("/sample", responses=problem_responses(403, 404, 422))
@needs("operator")
def open_sample_studies(store: Store, settings: ServiceSettings) -> SampleImport:
    """Take in the sample studies; asked again, they are the same ones."""
    paths = sample_studies()
    if not paths:
        raise ApiError(404, "No sample study comes with this version; launch one of the templates instead.")
    imports = [_answer(import_study(store, settings, path, f"The sample study {path.name}")) for path in paths]
    return SampleImport(studies=imports)


@router.post(
    "", responses=problem_responses(400, 403, 413, 422), openapi_extra=UPLOAD, max_body_size=LARGEST_STUDY_FILE
)
@needs("operator")
async def upload_study(request: Request, store: Store, settings: ServiceSettings) -> StudyImport:
    """Take in a study file; the same file twice is the same study. It is treated as if it came from anyone."""
    # Beside the data, where there has to be room for it anyway. What is still held back is written at the file's end.
    no_room = explain_no_room("the uploaded file", settings.home)
    with no_room, tempfile.TemporaryFile(dir=settings.home, prefix=".upload-") as file:
        await _receive(request, file)
        imported = await run_in_threadpool(import_study, store, settings, file, "The uploaded file")
    return _answer(imported)


@router.get("/{study_id}", responses={**DOWNLOAD, **problem_responses(404, 409, 422)}, response_class=FileResponse)
@needs("viewer")
def download_study(study_id: str, store: Store, settings: ServiceSettings) -> FileResponse:
    """Pack a study into one file: its curves, configs, final policies, models and a few episodes."""
    with tempfile.NamedTemporaryFile(dir=settings.home, prefix=".study-", suffix=".zip", delete=False) as file:
        path = Path(file.name)
    try:
        pack_study(store, settings, study_id, path)
    except BaseException:
        path.unlink()
        raise
    return _SentOnce(path, media_type=ARCHIVE, filename=f"study-{study_id}.zip")


class _SentOnce(FileResponse):
    """Send a file that was made for one answer, and remove it even if the part that was asked for cannot be sent."""

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            await super().__call__(scope, receive, send)
        finally:
            Path(self.path).unlink()


async def _receive(request: Request, file: BinaryIO) -> None:
    """Write a request's body to a file.

    Raises:
        ApiError: it is longer than any study file.
    """
    received = 0
    async for piece in request.stream():
        received += len(piece)
        if received > LARGEST_STUDY_FILE:
            raise ApiError(413, f"A study file has {LARGEST_STUDY_FILE / 2**20:.0f} MB at most; this one is longer.")
        file.write(piece)
    file.seek(0)


def _answer(imported: Imported) -> StudyImport:
    return StudyImport(study_id=imported.study_id, runs=imported.runs, already_there=imported.already_there)
