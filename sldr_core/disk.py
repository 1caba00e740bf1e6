"""Files on the disk: written whole or not at all, room for them asked for first, a full disk explained, turns taken."""

from __future__ import annotations

import errno
import fcntl
import os
import re
import secrets
import shutil
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from sldr_core.errors import DiskTooFull

NO_ROOM = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG})
"""What the system says when a disk is full, a quota is used up, or a file may grow no more."""

MARGIN = 32 * 2**20
"""Disk space left free beside the files of a run [bytes]."""

TOKEN_BYTES = 6
"""What sets a temporary name apart [bytes]."""


def check_room(directory: Path, sizes: Mapping[str, int]) -> None:
    """Refuse to start a run whose files would not fit.

    Args:
        directory: the run's directory.
        sizes: how large each of its files becomes [bytes], by name; those that are there already count as that much.

    Raises:
        DiskTooFull: they would not fit.
    """
    missing = {name: size - _held(directory / name) for name, size in sizes.items() if size > _held(directory / name)}
    free = shutil.disk_usage(directory).free
    if missing and free < sum(missing.values()) + MARGIN:
        largest = max(missing, key=lambda name: missing[name])
        raise DiskTooFull(
            f"The run's files in {directory} need {_amount(sum(missing.values()) + MARGIN)} more "
            f"({_amount(missing[largest])} of it for {largest}) and the disk has {_amount(free)} free; "
            "lower replay.capacity or free some space (the replay.bin of a finished run is no longer needed)."
        )


@contextmanager
def explain_full_disk(path: Path) -> Iterator[None]:
    """Turn the system's word for a full disk into ours, naming the file that was to be written.

    Raises:
        DiskTooFull: there was no room for it.
    """
    try:
        yield
    except OSError as err:
        if err.errno not in NO_ROOM:
            raise
        raise DiskTooFull(
            f"There is no room for {path}: its disk has {_amount(shutil.disk_usage(path.parent).free)} free or a quota "
            "is used up; free some space (the replay.bin of a finished run is no longer needed) and start again: "
            "the run goes on from its last checkpoint."
        ) from err


def write_atomically(path: Path, write: Callable[[Path], None]) -> Path:
    """Let `write` fill a temporary file beside `path`, sync it, and rename it to `path`.

    A reader sees the old file or the new one, whenever this process or the machine dies.

    Raises:
        DiskTooFull: there is no room for it; the old file is left as it was.
    """
    temporary = temporary_beside(path)
    try:
        with explain_full_disk(path):
            write(temporary)
            sync(temporary)
            temporary.rename(path)
    finally:
        temporary.unlink(missing_ok=True)
    sync(path.parent)
    return path


def temporary_beside(path: Path) -> Path:
    """Return a name for what is to become `path`, which no other thread, process or machine chooses.

    It ends in this process's id, by which what a killed one has left is told from what a living one writes.
    """
    return path.with_name(f".{path.name}.{secrets.token_hex(TOKEN_BYTES)}.{os.getpid()}.tmp")


def remove_leftovers(directory: Path) -> None:
    """Remove the temporary files of processes that were killed while they wrote; those of living ones stay."""
    for path in directory.glob(".*.tmp"):
        writer = re.fullmatch(r"\..+\.(\d+)\.tmp", path.name)
        if writer and not _is_another_living(int(writer[1])):
            path.unlink(missing_ok=True)


def sync(path: Path) -> None:
    """Bring a file, or the names in a directory, to the disk, if it is there."""
    if path.exists():
        descriptor = os.open(path, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


@contextmanager
def hold_lock(path: Path) -> Iterator[None]:
    """Wait until no other thread or process of this machine holds the lock of this file, and hold it."""
    with path.open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def _is_another_living(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        pass
    return pid != os.getpid()


def _held(path: Path) -> int:
    return path.stat().st_size if path.exists() else 0


def _amount(count: int) -> str:
    return f"{count / 1e9:.1f} GB" if count >= 1e8 else f"{count / 1e6:.1f} MB"
