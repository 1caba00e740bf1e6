"""Files of weights, written whole and read as data alone: nothing in them is ever executed."""

from __future__ import annotations

import io
import pickle
import zlib
from pathlib import Path
from typing import Any
from zipfile import BadZipFile, ZipFile

import torch

from sldr_core.errors import BadFile

_UNREADABLE = (
    BadZipFile,
    EOFError,
    AttributeError,
    LookupError,
    NotImplementedError,
    RuntimeError,
    TypeError,
    ValueError,
    pickle.UnpicklingError,
    zlib.error,
)
"""What zipfile and torch.load raise on files that are cut short, damaged or foreign."""

UNFIT = (AttributeError, LookupError, OverflowError, TypeError, ValueError, RuntimeError)
"""What filling networks and counters raises if a readable file holds something else than they do."""


def save_tensors(path: Path, content: dict[str, Any]) -> None:
    """Write a file of tensors and plain values.

    Raises:
        OSError: the disk is full, and the like.
    """
    # By way of memory: writing to the disk itself, torch.save tells a full one as an internal fault of its own.
    path.write_bytes(pack_tensors(content))


def pack_tensors(content: dict[str, Any]) -> bytes:
    """Return what a file of tensors and plain values holds."""
    packed = io.BytesIO()
    torch.save(content, packed)
    return packed.getvalue()


def load_tensors(path: Path, *kinds: str, way_out: str = "restore it from a copy or train again") -> dict[str, Any]:
    """Read a file of tensors and plain values.

    Args:
        path: the file.
        kinds: what the file may call itself.
        way_out: what one who finds it damaged can do.

    Raises:
        BadFile: it is missing, truncated, corrupt or of another kind.
    """
    if not path.is_file():
        raise BadFile(f"There is no file {path}; give the path of a {' or '.join(kinds)}.")
    try:
        packed = path.read_bytes()
        _check_sums(packed)
        content = torch.load(io.BytesIO(packed), map_location="cpu", weights_only=True)
    except _UNREADABLE as err:
        raise BadFile(f"{path} is corrupt or no file of ours; {way_out}.") from err
    kind = content.get("kind") if isinstance(content, dict) else None
    told = kind if isinstance(kind, str) and kind else "foreign object"
    if told not in kinds:
        raise BadFile(f"{path} holds a {one_line(told)}, but a {' or '.join(kinds)} is needed.")
    return content


def one_line(err: Exception | str) -> str:
    """Return what is said, by an error for one, without its line breaks."""
    return " ".join(str(err).split())


def _check_sums(packed: bytes) -> None:
    """Read the whole archive: torch.load itself takes damaged weights for good ones."""
    # From memory, where a damaged offset is a ValueError; on a disk it would be an OSError, as if the disk failed.
    with ZipFile(io.BytesIO(packed)) as archive:
        damaged = archive.testzip()
    if damaged is not None:
        raise BadZipFile(f"{damaged} is damaged")
