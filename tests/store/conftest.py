"""A fresh store for each test."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from backend.store.database import Database, open_database
from backend.store.settings import Settings, sqlite_url


@pytest.fixture(scope="session")
def migrated(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the file of an empty store; copying it is faster than migrating again."""
    home = tmp_path_factory.mktemp("migrated")
    open_database(Settings(home=home, database_url=sqlite_url(home))).close()
    return home / "sldr.db"


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    """Return a fresh data directory."""
    return Settings(home=tmp_path, database_url=sqlite_url(tmp_path))


@pytest.fixture
def db(settings: Settings, migrated: Path) -> Iterator[Database]:
    """Return an empty store."""
    shutil.copy(migrated, settings.home)
    database = open_database(settings)
    yield database
    database.close()
