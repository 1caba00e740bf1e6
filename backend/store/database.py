"""The connection to the store: one engine, short transactions, migrated to head when opened."""

from __future__ import annotations

from collections.abc import Generator
from contextlib import contextmanager, nullcontext, suppress
from datetime import UTC, datetime
from itertools import count
from pathlib import Path

from sqlalchemy import URL, Connection, Engine, Update, event, func, inspect, select, text
from sqlalchemy.exc import DataError, DBAPIError, OperationalError
from sqlalchemy.exc import TimeoutError as NoConnectionFree
from sqlalchemy.pool import ConnectionPoolEntry

from backend.store.engines import for_noting, for_reading, for_writing, open_engine, parse_address
from backend.store.errors import StoreTooNew, StoreUnavailable, Unstorable
from backend.store.settings import Settings
from backend.store.tables import SCHEMA_REVISION
from sldr_core.disk import hold_lock

MIGRATION_TURN = 0x534C4452
"""Whose turn it is to migrate a PostgreSQL store: the key of an advisory lock."""
LAUNCH_TURN = MIGRATION_TURN + 1
"""Whose turn it is to launch; see `take_turn`."""


class Database:
    """Hand out transactions of the store. Share one between threads."""

    def __init__(self, engine: Engine) -> None:
        self._reader = for_reading(engine)
        self._writer = for_writing(engine)
        self._noter = for_noting(engine)
        self._is_closed = False
        # A counter's step is one piece even between threads, which `+= 1` is not.
        self._writes = count()
        self.writes = next(self._writes)
        """How often this process has written what others read: what was read before is out of date."""
        event.listen(engine, "checkin", self._close_if_late)

    @property
    def engine_name(self) -> str:
        """Which database it is: `sqlite` or `postgresql`."""
        return self._writer.dialect.name

    @contextmanager
    def read(self) -> Generator[Connection]:
        """Open a transaction that only reads, and sees one state of the store."""
        with _transaction(self._reader) as conn:
            yield conn

    @contextmanager
    def write(self, is_news: bool = True) -> Generator[Connection]:
        """Open a transaction that writes.

        On SQLite it waits for its turn before it reads anything. On PostgreSQL writers go on beside each other: lock
        the rows that a decision hangs on (`with_for_update`), or take turns (`take_turn`).

        Args:
            is_news: whether what others have read may be out of date afterwards.
        """
        try:
            with _transaction(self._writer) as conn:
                yield conn
        finally:
            if is_news:
                self.writes = next(self._writes)

    def note(self, statement: Update) -> None:
        """Write what may be left out, as when somebody was last here: if the store is busy just now, it is left out."""
        with suppress(StoreUnavailable), _transaction(self._noter) as conn:
            conn.execute(statement)

    def close(self) -> None:
        """Close every connection; one that another thread still uses is closed when that thread is done with it."""
        self._is_closed = True
        self._writer.dispose()

    def _close_if_late(self, _connection: object, record: ConnectionPoolEntry) -> None:
        # Without this it would wait in a pool that nobody looks at any more.
        if self._is_closed:
            record.invalidate()


def open_database(settings: Settings) -> Database:
    """Open the store and bring its tables up to date; safe when several processes start at once.

    Raises:
        BadAddress: the address of the store cannot work.
        StoreTooNew: a later version of this program has used the store.
        StoreUnavailable: the store cannot be reached.
    """
    settings.home.mkdir(parents=True, exist_ok=True)
    url = parse_address(settings.database_url)
    engine = open_engine(url)
    database = Database(engine)
    try:
        _bring_up_to_date(database, engine, url)
    except BaseException:
        database.close()
        raise
    return database


def _bring_up_to_date(database: Database, engine: Engine, url: URL) -> None:
    is_sqlite = database.engine_name == "sqlite"
    with hold_lock(Path(f"{url.database}.lock")) if is_sqlite else nullcontext():
        if is_sqlite:
            _use_write_ahead_log(engine)
        _migrate(database)


def current_time(conn: Connection) -> datetime:
    """Return the store's time, so that machines whose clocks differ agree on leases."""
    if conn.dialect.name == "sqlite":
        return datetime.now(UTC)
    return conn.execute(select(func.clock_timestamp())).scalar_one().astimezone(UTC)


def take_turn(conn: Connection, turn: int) -> None:
    """Wait until no other transaction has this turn, and keep it until this one ends.

    On SQLite the whole of a writing transaction is a turn already.
    """
    if conn.dialect.name != "sqlite":
        conn.execute(select(func.pg_advisory_xact_lock(turn)))


@contextmanager
def _transaction(engine: Engine) -> Generator[Connection]:
    try:
        with engine.begin() as conn:
            yield conn
    except NoConnectionFree as err:
        raise StoreUnavailable("The store cannot be used just now: all its connections are taken.") from err
    except DataError as err:
        raise Unstorable(f"The store cannot hold or compare a value: {_first_line(err)}.") from err
    except DBAPIError as err:
        if isinstance(err, OperationalError) or err.connection_invalidated:
            raise StoreUnavailable(f"The store cannot be used just now: {_first_line(err)}.") from err
        raise


def _first_line(err: DBAPIError) -> str:
    """Return what the driver says; PostgreSQL adds lines of advice and of context."""
    lines = str(err.orig).strip().splitlines()
    return lines[0].rstrip(".") if lines else type(err.orig).__name__


def _use_write_ahead_log(engine: Engine) -> None:
    """Let readers and one writer work at once; the mode stays in the file."""
    connection = engine.raw_connection()
    try:
        cursor = connection.cursor()
        cursor.execute("PRAGMA journal_mode=WAL")
        cursor.close()
    finally:
        connection.close()


def _migrate(database: Database) -> None:
    with database.read() as conn:
        if read_table_revision(conn) == SCHEMA_REVISION:
            return
    # Alembic takes a third of a second to import: only when needed.
    from alembic.util import CommandError

    from backend.store.migrations import upgrade

    with database.write() as conn:
        take_turn(conn, MIGRATION_TURN)
        try:
            upgrade(conn)
        except CommandError as err:
            raise StoreTooNew(
                f"The store's tables are of revision {read_table_revision(conn)}, which this version does not know; "
                "start the newer version that has used it, or restore a backup made before."
            ) from err


def read_table_revision(conn: Connection) -> str | None:
    """Return the migration that a store's tables are of; None if it has none yet."""
    if not inspect(conn).has_table("alembic_version"):
        return None
    return conn.execute(text("SELECT version_num FROM alembic_version")).scalar_one_or_none()
