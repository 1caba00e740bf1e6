"""SQLite and PostgreSQL: how each is opened so that the rest of the store need not know which one it has."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from sqlalchemy import URL, Connection, Engine, create_engine, event, make_url
from sqlalchemy.exc import ArgumentError, NoSuchModuleError

from backend.store.errors import BadAddress

BUSY_TIMEOUT_S = 30.0
"""How long a writer waits for another one: for all of SQLite, for a row of PostgreSQL [s]."""
CONNECT_TIMEOUT_S = 10
"""How long PostgreSQL may take to accept a connection [s]."""
SILENCE_S = 30
"""A PostgreSQL machine that acknowledges nothing for this long counts as gone [s]."""
CONNECTION = {
    "connect_timeout": CONNECT_TIMEOUT_S,
    "keepalives_idle": SILENCE_S // 3,
    "keepalives_interval": SILENCE_S // 6,
    "keepalives_count": 4,
    "tcp_user_timeout": 1000 * SILENCE_S,
    "application_name": "sldr",
}
"""How PostgreSQL is connected to, unless the address says otherwise."""
IDLE_TRANSACTION_S = 20
"""PostgreSQL ends a transaction whose process has stood still for this long, and frees what it held [s].

Well below a lease: when the runs of a stopped worker are given to others, it must not hold their rows any more.
"""
SQLITE_CACHE_KIB = 16_000
"""Pages that a connection to SQLite keeps in memory: a table of thousands of runs is read from there [KiB]."""
POOL_SIZE = 5
"""Connections that a process keeps open to PostgreSQL."""
POOL_OVERFLOW = 35
"""Further ones in moments of need: the API answers up to 40 requests at once."""
WRITE_OPTION = "sldr_write"
"""Execution option that marks a transaction as one that writes."""
PATIENCE_OPTION = "sldr_patience_s"
"""Execution option that names how long a transaction on SQLite waits for another writer [s]."""
SHORT_PATIENCE_S = 0.1
"""How long to wait for the sake of what may be left out [s]."""
EXTRA = "postgresql"
"""The extra of this package that brings the driver of PostgreSQL."""


def parse_address(address: str) -> URL:
    """Return an address of the store as its parts.

    Raises:
        BadAddress: it is none, or names a database other than SQLite and PostgreSQL.
    """
    try:
        url = make_url(address)
    except ArgumentError as err:
        raise BadAddress(f"SLDR_DATABASE_URL is no address of a database; {_EXAMPLE}.") from err
    if url.get_backend_name() not in ("sqlite", "postgresql"):
        raise BadAddress(
            f"SLDR_DATABASE_URL names a database of the kind '{url.drivername}', and runs can be kept in SQLite "
            f"or PostgreSQL; {_EXAMPLE}."
        )
    return url


def open_engine(url: URL) -> Engine:
    """Return the engine of a store; PostgreSQL is first spoken to when it is first used.

    Raises:
        BadAddress: the driver of PostgreSQL is missing, or another one is named.
    """
    return _open_sqlite(url) if url.get_backend_name() == "sqlite" else _open_postgresql(url)


def for_reading(engine: Engine) -> Engine:
    """Return the engine whose transactions only read, and see one state of the store from their first look on."""
    if engine.dialect.name == "sqlite":
        return engine
    return engine.execution_options(isolation_level="REPEATABLE READ", postgresql_readonly=True)


def for_writing(engine: Engine) -> Engine:
    """Return the engine whose transactions write."""
    return engine.execution_options(**{WRITE_OPTION: True})


def for_noting(engine: Engine) -> Engine:
    """Return the engine whose transactions write, but hardly wait for others."""
    return engine.execution_options(**{WRITE_OPTION: True, PATIENCE_OPTION: SHORT_PATIENCE_S})


def _open_sqlite(url: URL) -> Engine:
    if url.database:
        Path(url.database).parent.mkdir(parents=True, exist_ok=True)
    engine = create_engine(url, connect_args={"timeout": BUSY_TIMEOUT_S})
    event.listen(engine, "connect", _set_up_sqlite)
    event.listen(engine, "begin", _begin_sqlite)
    return engine


def _open_postgresql(url: URL) -> Engine:
    if url.get_driver_name() not in ("psycopg", ""):
        raise BadAddress(
            f"SLDR_DATABASE_URL asks for the driver '{url.get_driver_name()}', and only psycopg is used; "
            "write postgresql+psycopg://..."
        )
    try:
        engine = create_engine(
            url.set(drivername="postgresql+psycopg"),
            pool_pre_ping=True,  # a server that was restarted is noticed before a transaction begins
            pool_size=POOL_SIZE,
            max_overflow=POOL_OVERFLOW,
            connect_args={name: value for name, value in CONNECTION.items() if name not in url.query},
        )
    except ModuleNotFoundError as err:
        raise BadAddress(
            f"SLDR_DATABASE_URL names a PostgreSQL store, and its driver psycopg is not installed; "
            f"install this package with its extra '{EXTRA}', in its directory: pip install '.[{EXTRA}]'."
        ) from err
    except NoSuchModuleError as err:
        raise BadAddress(f"SLDR_DATABASE_URL cannot be used ({err}); {_EXAMPLE}.") from err
    event.listen(engine, "connect", _set_up_postgresql)
    return engine


def _set_up_sqlite(connection: Any, _record: object) -> None:
    # The driver's own transaction control starts writers too late; `_begin_sqlite` does it instead.
    connection.isolation_level = None
    for pragma in ("foreign_keys=ON", "synchronous=NORMAL", f"cache_size=-{SQLITE_CACHE_KIB}"):
        connection.execute(f"PRAGMA {pragma}")


def _begin_sqlite(conn: Connection) -> None:
    options = conn.get_execution_options()
    begin = "BEGIN IMMEDIATE" if options.get(WRITE_OPTION, False) else "BEGIN"
    if PATIENCE_OPTION not in options:
        conn.exec_driver_sql(begin)
        return
    _wait_at_most(conn, options[PATIENCE_OPTION])
    try:
        conn.exec_driver_sql(begin)
    finally:
        _wait_at_most(conn, BUSY_TIMEOUT_S)


def _wait_at_most(conn: Connection, patience_s: float) -> None:
    conn.exec_driver_sql(f"PRAGMA busy_timeout={1000 * patience_s:.0f}")


def _set_up_postgresql(connection: Any, _record: object) -> None:
    connection.execute(f"SET lock_timeout = '{BUSY_TIMEOUT_S:g}s'")
    connection.execute(f"SET idle_in_transaction_session_timeout = '{IDLE_TRANSACTION_S}s'")
    connection.commit()


_EXAMPLE = "write sqlite:////path/sldr.db or postgresql+psycopg://user:password@host/database"
