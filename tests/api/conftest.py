"""An API over a fresh data directory."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from live_api import Service, serving_client
from store_engines import SqliteStores

from backend.api.app import create_app
from backend.store.settings import Settings


@pytest.fixture
def built_page(tmp_path: Path) -> Path:
    """Return a directory where a built page would be; a test may fill it."""
    return tmp_path / "dist"


@pytest.fixture
def service(settings: Settings, built_page: Path) -> Iterator[Service]:
    """Return the API over an empty store, ready to answer."""
    with _open(settings, built_page) as service:
        yield service


@pytest.fixture(scope="session")
def unused_service(sqlite_stores: SqliteStores, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    """Return the API over an empty store, for tests that leave it empty."""
    home = tmp_path_factory.mktemp("unused")
    with sqlite_stores.fresh(home) as settings, _open(settings, home / "dist") as service:
        yield service


@pytest.fixture(scope="module")
def module_service(sqlite_stores: SqliteStores, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    """Return the API over a store that the tests of one file share."""
    home = tmp_path_factory.mktemp("shared")
    with sqlite_stores.fresh(home) as settings, _open(settings, home / "dist") as service:
        yield service


@contextmanager
def _open(settings: Settings, built_page: Path) -> Iterator[Service]:
    app = create_app(settings, built_page)
    with serving_client(app) as client:
        yield Service(client=client, settings=settings, database=app.state.service.database)
