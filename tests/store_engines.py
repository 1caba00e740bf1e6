"""Fresh stores on SQLite and on PostgreSQL, each a copy of one that was migrated once."""

from __future__ import annotations

import shutil
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from postgres_server import PostgresServer

from backend.store.database import open_database
from backend.store.settings import Settings, sqlite_url
from backend.store.tables import SCHEMA_REVISION

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
    """Hand out PostgreSQL stores, one database each; one that was left in order is emptied and lent again."""

    def __init__(self, server: PostgresServer, directory: Path) -> None:
        self._server = server
        self._migrated = server.create_database()
        self._emptied: list[str] = []
        open_database(Settings(home=directory, database_url=server.url(self._migrated))).close()

    @contextmanager
    def fresh(self, home: Path, empty: bool = False) -> Generator[Settings]:
        """Lend a store for a data directory; an empty one has no tables yet."""
        if empty:
            name = self._server.create_database()
        else:
            name = self._emptied.pop() if self._emptied else self._server.create_database(self._migrated)
        yield Settings(home=home, database_url=self._server.url(name))
        # To make a database takes ten times as long as to empty one.
        if not empty and self._server.empty_database(name, SCHEMA_REVISION):
            self._emptied.append(name)
        else:
            self._server.drop_database(name)


Stores = SqliteStores | PostgresStores
