"""Looking at a store without changing it: which tables it has, before anything brings them up to date."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from backend.store.database import Database, read_table_revision
from backend.store.engines import open_engine, parse_address
from backend.store.settings import Settings
from backend.store.tables import SCHEMA_REVISION


@dataclass(frozen=True)
class StoreState:
    """Say which tables a store has."""

    engine: str
    """`sqlite` or `postgresql`."""
    revision: str | None
    """The migration that its tables are of; None if it has none yet."""
    expected: str
    """The migration that this version needs."""


def inspect_store(settings: Settings) -> StoreState:
    """Return which tables a store has; it is not migrated, and an SQLite file is not made.

    Raises:
        BadAddress: the address of the store cannot work.
        StoreUnavailable: the store cannot be reached.
    """
    url = parse_address(settings.database_url)
    if url.get_backend_name() == "sqlite" and url.database and not Path(url.database).exists():
        return StoreState("sqlite", None, SCHEMA_REVISION)
    database = Database(open_engine(url))
    try:
        with database.read() as conn:
            return StoreState(database.engine_name, read_table_revision(conn), SCHEMA_REVISION)
    finally:
        database.close()
