"""Sending stored files, or ranges of them, from this machine or from the place that machines share."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import chain
from pathlib import PurePath
from urllib.parse import quote

from fastapi.responses import FileResponse, Response, StreamingResponse

from backend.api.errors import ApiError
from backend.store.files import FileRow
from backend.store.storage import FileStorage

MEDIA_TYPE = "application/octet-stream"
"""Of files to be kept by whoever asks."""

SHOWN_TYPES = {".mp4": "video/mp4", ".webm": "video/webm", ".webp": "image/webp"}
"""Of files that a page shows, by their ending."""


def send_file(storage: FileStorage, row: FileRow, byte_range: str | None) -> Response:
    """Answer with a file.

    Args:
        byte_range: the request's Range header.

    Raises:
        ApiError: the range cannot be answered, or the file is gone.
        FileGone: it is gone from the shared place.
        FilesUnavailable: the shared place cannot be read just now.
    """
    path = storage.find_here(row)
    if path is not None:
        if byte_range is not None:
            _read_range(byte_range, path.stat().st_size)
        media_type, disposition = _manner(row.name)
        return FileResponse(path, media_type=media_type, filename=row.name, content_disposition_type=disposition)
    if storage.shared is None:
        raise ApiError(404, f"File {row.name} of run {row.run_id} is recorded but no longer on the disk.")
    return _stream(storage, row, byte_range)


def _manner(name: str) -> tuple[str, str]:
    """Return the media type of a file, and whether it is for the page to show or for the disk."""
    shown = SHOWN_TYPES.get(PurePath(name).suffix)
    return (MEDIA_TYPE, "attachment") if shown is None else (shown, "inline")


def _stream(storage: FileStorage, row: FileRow, byte_range: str | None) -> Response:
    media_type, disposition = _manner(row.name)
    headers = {
        "accept-ranges": "bytes",
        "content-disposition": f"{disposition}; filename*=utf-8''{quote(row.name)}",
        "etag": f'"{row.sha256}"',
    }
    start, end = (0, row.size) if byte_range is None else _read_range(byte_range, row.size)
    headers["content-length"] = str(end - start)
    if byte_range is not None:
        headers["content-range"] = f"bytes {start}-{end - 1}/{row.size}"
    pieces = storage.read(row, start)
    # The first piece is read before the answer begins, so that a place out of reach is an error and no cut-off file.
    content = _cut(chain([next(pieces, b"")], pieces), end - start)
    return StreamingResponse(content, 200 if byte_range is None else 206, headers, media_type)


def _cut(pieces: Iterator[bytes], length: int) -> Iterator[bytes]:
    """Pass on the first `length` bytes."""
    for piece in pieces:
        yield piece[:length]
        length -= len(piece)
        if length <= 0:
            return


def _read_range(byte_range: str, size: int) -> tuple[int, int]:
    """Return first byte and end of the range that is asked for; refuse in our own words what cannot be answered."""
    # Python refuses to read numbers of thousands of digits; no file is longer than these say.
    parts = re.fullmatch(r"bytes=(\d{0,18})-(\d{0,18})", byte_range.strip())
    if parts is None or parts.groups() == ("", ""):
        raise ApiError(416, f"Range '{byte_range:.50}' cannot be answered; ask for one, as in bytes=0-1023.", "Range")
    first, last = parts.groups()
    if not first:
        start, end = max(0, size - int(last)), size
    else:
        start, end = int(first), min(size, int(last) + 1) if last else size
    if start >= end:
        raise ApiError(416, f"Range '{byte_range}' lies outside the file of {size} bytes.", "Range")
    return start, end
