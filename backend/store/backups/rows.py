"""Copying all rows from one store to another, whatever their engines."""

from __future__ import annotations

from collections.abc import Callable

from sqlalchemy import Connection, Table, delete, func, insert, select

from backend.store.tables import metadata

BATCH = 2000
"""Rows that travel at once."""

Tell = Callable[[str], None]
"""Takes one sentence for the user."""


def copy_rows(source: Connection, target: Connection, tell: Tell) -> None:
    """Copy every row; the tables of the target are there, and empty."""
    for table in metadata.sorted_tables:
        _copy_table(source, target, table, tell)
        _go_on_counting(target, table)


def delete_rows(conn: Connection) -> None:
    """Empty every table."""
    for table in reversed(metadata.sorted_tables):
        conn.execute(delete(table))


def count_rows(conn: Connection, table: Table) -> int:
    """Return how many rows a table has."""
    return conn.execute(select(func.count()).select_from(table)).scalar_one()


def _copy_table(source: Connection, target: Connection, table: Table, tell: Tell) -> None:
    total = count_rows(source, table)
    copied = 0
    rows = source.execute(select(table).execution_options(yield_per=BATCH)).mappings()
    for batch in rows.partitions():
        target.execute(insert(table), [dict(row) for row in batch])
        copied += len(batch)
        tell(f"Rows of {table.name}: {copied} of {total}.")


def _go_on_counting(conn: Connection, table: Table) -> None:
    """Let PostgreSQL number the next row after those that came with a number."""
    column = table.autoincrement_column
    if conn.dialect.name != "postgresql" or column is None:
        return
    newest = conn.execute(select(func.max(column))).scalar_one()
    if newest:
        conn.execute(select(func.setval(func.pg_get_serial_sequence(table.name, column.name), newest)))
