"""Fresh stores on SQLite and on PostgreSQL, each a copy of one that was migrated once."""

from __future__ import annotations

import shutil
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from postgres_server import PostgresServer

from backend.store.database import open_database
from backend.store.settings import Settings, sqlite_url

ENGINES = ("sqlite", "postgresql")


class SqliteStores:
    """Hand out SQLite stores, one file each."""

    def __init__(self, directory: Path) -> None:
        settings = Settings(home=directory, database_url=sqlite_url(directory))
        open_database(settings).close()
        self._migrated = directory / "sldr.db"

    @contextmanager
    def fresh(self, home: Path, empty: bool = False) -> Generator[Settings]:
        """Lend a store for a data directory; an empty one has no tables yet."""
        if not empty:
            shutil.copy(self._migrated, home)
        yield Settings(home=home, database_url=sqlite_url(home))


class PostgresStores:
    """Hand out PostgreSQL stores, one database each."""

    def __init__(self, server: PostgresServer, directory: Path) -> None:
        self._server = server
        self._migrated = server.create_database()
        open_database(Settings(home=directory, database_url=server.url(self._migrated))).close()

    @contextmanager
    def fresh(self, home: Path, empty: bool = False) -> Generator[Settings]:
        """Lend a store for a data directory; an empty one has no tables yet."""
        name = self._server.create_database("template0" if empty else self._migrated)
        yield Settings(home=home, database_url=self._server.url(name))
        self._server.drop_database(name)


Stores = SqliteStores | PostgresStores
