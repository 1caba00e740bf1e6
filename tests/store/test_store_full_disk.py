"""A full disk is told in one sentence, whoever met it."""

from __future__ import annotations

import errno
import sqlite3
from pathlib import Path

import pytest
from sqlalchemy import create_engine, text
from sqlalchemy.exc import OperationalError

from backend.store.errors import StoreUnavailable
from backend.store.full_disk import explain_no_room
from sldr_core.errors import DiskTooFull


def fill_a_store() -> None:
    """Write more than a store may hold, and let it be told as the store tells it."""
    with create_engine("sqlite://").begin() as conn:
        conn.execute(text("PRAGMA max_page_count=2"))
        try:
            conn.execute(text("CREATE TABLE held AS SELECT randomblob(100000)"))
        except OperationalError as err:
            raise StoreUnavailable("The store cannot be used just now.") from err


def test_a_store_that_is_full_is_a_full_disk(tmp_path: Path) -> None:
    told = r"no room for the study in .*; nothing of it is left\."
    with pytest.raises(DiskTooFull, match=told), explain_no_room("the study", tmp_path):
        fill_a_store()


@pytest.mark.parametrize(
    "error", [OSError(errno.EACCES, "no"), StoreUnavailable("It is locked."), sqlite3.OperationalError("locked")]
)
def test_what_has_nothing_to_do_with_the_disk_is_left_alone(tmp_path: Path, error: Exception) -> None:
    with pytest.raises(type(error)) as raised, explain_no_room("the study", tmp_path):
        raise error
    assert raised.value is error
