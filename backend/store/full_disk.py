"""A full disk in one sentence, whoever met it: the system, SQLite, or what writes files of runs."""

from __future__ import annotations

import shutil
import sqlite3
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from sqlalchemy.exc import DBAPIError

from backend.store.errors import StoreUnavailable
from sldr_core.disk import NO_ROOM
from sldr_core.errors import DiskTooFull


@contextmanager
def explain_no_room(what: str, directory: Path) -> Generator[None]:
    """Say of what there is nothing left because a disk is full.

    Args:
        what: what the block writes, as a user calls it.
        directory: where it does so.

    Raises:
        DiskTooFull: there was no room for it.
    """
    try:
        yield
    except (OSError, sqlite3.Error, StoreUnavailable, DiskTooFull) as err:
        if not _says_full(err):
            raise
        free = shutil.disk_usage(directory).free
        raise DiskTooFull(
            f"There is no room for {what} in {directory}: its disk has {free / 1e6:,.0f} MB free or a quota is used "
            "up; nothing of it is left. Free some space (`sldr retention --preview` shows what can go) and try again."
        ) from err


def _says_full(err: BaseException | None) -> bool:
    if isinstance(err, OSError):
        return err.errno in NO_ROOM
    if isinstance(err, sqlite3.Error):
        return getattr(err, "sqlite_errorcode", None) == sqlite3.SQLITE_FULL
    if isinstance(err, DBAPIError):
        return _says_full(err.orig)
    if isinstance(err, StoreUnavailable):
        return _says_full(err.__cause__)
    return isinstance(err, DiskTooFull)
