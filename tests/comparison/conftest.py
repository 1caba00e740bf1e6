"""A store with curves, filled once."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from store_engines import SqliteStores
from store_samples import SampleSize, fill_store

from backend.store.database import Database, open_database


@pytest.fixture(scope="session")
def sample_db(sqlite_stores: SqliteStores, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Database]:
    """Return a store with two tasks, two methods and three seeds that nobody changes."""
    with sqlite_stores.fresh(tmp_path_factory.mktemp("sample")) as settings:
        database = open_database(settings)
        fill_store(database, SampleSize())
        yield database
        database.close()
