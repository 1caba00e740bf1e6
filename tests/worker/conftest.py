"""A fresh store for each test."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from backend.store.database import Database, open_database
from backend.store.settings import Settings, sqlite_url


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    """Return a fresh data directory."""
    return Settings(home=tmp_path, database_url=sqlite_url(tmp_path))


@pytest.fixture
def db(settings: Settings) -> Iterator[Database]:
    """Return an empty store."""
    database = open_database(settings)
    yield database
    database.close()
