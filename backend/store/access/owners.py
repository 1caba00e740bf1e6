"""Whose a session or a token is: an account's, or nobody's, as what was made on loopback."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from sqlalchemy import Column, ColumnElement, Connection, Select, select

from backend.store.access.accounts import Account, account_of
from backend.store.access.tables import accounts
from backend.store.tables import AnyRow


def belongs_to(owner: Column[Any], account_id: str | None) -> ColumnElement[bool]:
    """Return the condition that what names its account in the column `owner` is this account's."""
    return owner.is_(None) if account_id is None else owner == account_id


def read_with_owner(
    conn: Connection, query: Select[Any], parameters: Mapping[str, Any] | None = None
) -> tuple[AnyRow, Account | None] | None:
    """Return the one row that a query finds and its account; None if there is none, or the account is disabled."""
    row = conn.execute(query, parameters).one_or_none()
    if row is None or row.account_id is None:
        return None if row is None else (row, None)
    owner = account_of(conn.execute(select(accounts).where(accounts.c.id == row.account_id)).one())
    return (row, owner) if owner.disabled_at is None else None
