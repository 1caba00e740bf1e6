"""The connection to the store: one engine, short transactions, migrated to head when opened."""

from __future__ import annotations

import fcntl
from collections.abc import Generator
from contextlib import contextmanager, nullcontext
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, Engine, create_engine, event, func, inspect, make_url, select, text
from sqlalchemy.exc import OperationalError

from backend.store.errors import StoreUnavailable
from backend.store.settings import Settings
from backend.store.tables import SCHEMA_REVISION

BUSY_TIMEOUT_S = 30.0
"""How long a writer waits for the others on SQLite [s]."""
MIGRATION_LOCK = 0x534C4452
"""Key of the advisory lock that lets one process at a time migrate a PostgreSQL store."""
WRITE_OPTION = "sldr_write"


class Database:
    """Hand out transactions of the store. Share one between threads."""

    def __init__(self, engine: Engine) -> None:
        self._reader = engine
        self._writer = engine.execution_options(**{WRITE_OPTION: True})

    @contextmanager
    def read(self) -> Generator[Connection]:
        """Open a transaction that only reads, and sees one state of the store."""
        with _transaction(self._reader) as conn:
            yield conn

    @contextmanager
    def write(self) -> Generator[Connection]:
        """Open a transaction that writes; on SQLite it waits for its turn before it reads anything."""
        with _transaction(self._writer) as conn:
            yield conn

    def close(self) -> None:
        """Close every connection."""
        self._reader.dispose()


def open_database(settings: Settings) -> Database:
    """Open the store and bring its tables up to date; safe when several processes start at once."""
    settings.home.mkdir(parents=True, exist_ok=True)
    url = make_url(settings.database_url)
    is_sqlite = url.get_backend_name() == "sqlite"
    if is_sqlite and url.database:
        Path(url.database).parent.mkdir(parents=True, exist_ok=True)
    engine = create_engine(url, connect_args={"timeout": BUSY_TIMEOUT_S} if is_sqlite else {})
    if is_sqlite:
        event.listen(engine, "connect", _set_up_sqlite)
        event.listen(engine, "begin", _begin_sqlite)
    database = Database(engine)
    lock = _file_lock(Path(f"{url.database}.lock")) if is_sqlite else nullcontext()
    with lock:
        if is_sqlite:
            _use_write_ahead_log(engine)
        _migrate(database)
    return database


def current_time(conn: Connection) -> datetime:
    """Return the store's time, so that machines whose clocks differ agree on leases."""
    if conn.dialect.name == "sqlite":
        return datetime.now(UTC)
    return conn.execute(select(func.clock_timestamp())).scalar_one().astimezone(UTC)


@contextmanager
def _transaction(engine: Engine) -> Generator[Connection]:
    try:
        with engine.begin() as conn:
            yield conn
    except OperationalError as err:
        raise StoreUnavailable(f"The store cannot be used just now: {err.orig}.") from err


def _set_up_sqlite(connection: Any, _record: object) -> None:
    # The driver's own transaction control starts writers too late; `_begin_sqlite` does it instead.
    connection.isolation_level = None
    for pragma in ("foreign_keys=ON", "synchronous=NORMAL"):
        connection.execute(f"PRAGMA {pragma}")


def _begin_sqlite(conn: Connection) -> None:
    writes = conn.get_execution_options().get(WRITE_OPTION, False)
    conn.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")


def _use_write_ahead_log(engine: Engine) -> None:
    """Let readers and one writer work at once; the mode stays in the file."""
    connection = engine.raw_connection()
    try:
        cursor = connection.cursor()
        cursor.execute("PRAGMA journal_mode=WAL")
        cursor.close()
    finally:
        connection.close()


@contextmanager
def _file_lock(path: Path) -> Generator[None]:
    with path.open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def _migrate(database: Database) -> None:
    with database.read() as conn:
        if _revision(conn) == SCHEMA_REVISION:
            return
    from backend.store.migrations import upgrade  # Alembic takes a third of a second to import: only when needed.

    with database.write() as conn:
        if conn.dialect.name == "postgresql":
            conn.execute(select(func.pg_advisory_xact_lock(MIGRATION_LOCK)))
        upgrade(conn)


def _revision(conn: Connection) -> str | None:
    if not inspect(conn).has_table("alembic_version"):
        return None
    return conn.execute(text("SELECT version_num FROM alembic_version")).scalar_one_or_none()
