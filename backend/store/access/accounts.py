"""Accounts: who may sign in, and as what."""

from __future__ import annotations

import uuid
from dataclasses import dataclass
from datetime import datetime

from sqlalchemy import Connection, func, insert, select, update
from sqlalchemy.exc import IntegrityError

from backend.store.access.roles import Role
from backend.store.access.tables import accounts
from backend.store.database import Database, current_time, take_turn
from backend.store.errors import NotFound, Refused
from backend.store.tables import AnyRow

ACCESS_TURN = 0x534C4460
"""Whose turn it is to decide who is an admin; see `take_turn`."""


@dataclass(frozen=True)
class Account:
    """Describe one account, without its password."""

    id: str
    name: str
    role: Role
    has_password: bool
    """Whether its owner has opened the link and set one."""
    created_at: datetime
    disabled_at: datetime | None


@dataclass(frozen=True)
class AccountChange:
    """Say what changes; None stays as it is."""

    role: Role | None = None
    disabled: bool | None = None


def create_account(db: Database, name: str, role: Role) -> Account:
    """Make an account without a password.

    Raises:
        Refused: there is one of that name.
    """
    try:
        with db.write() as conn:
            return insert_account(conn, name, role)
    except IntegrityError as err:
        raise Refused(f"There is an account called '{name}' already; choose another name.") from err


def list_accounts(db: Database) -> list[Account]:
    """Return every account, by name."""
    with db.read() as conn:
        return [account_of(row) for row in conn.execute(select(accounts).order_by(accounts.c.name))]


def get_account(db: Database, account_id: str) -> Account:
    """Return one account.

    Raises:
        NotFound: there is no such account.
    """
    with db.read() as conn:
        return account_of(_row(conn, account_id))


def find_password(db: Database, name: str) -> tuple[Account, str] | None:
    """Return the account of that name with the hash of its password, if it may sign in."""
    query = select(accounts).where(
        accounts.c.name == name, accounts.c.password_hash.is_not(None), accounts.c.disabled_at.is_(None)
    )
    with db.read() as conn:
        row = conn.execute(query).one_or_none()
    return None if row is None else (account_of(row), row.password_hash)


def set_password(db: Database, account_id: str, password_hash: str) -> None:
    """Replace the password of an account.

    Raises:
        NotFound: there is no such account.
    """
    with db.write() as conn:
        _row(conn, account_id)
        conn.execute(update(accounts).where(accounts.c.id == account_id).values(password_hash=password_hash))


def change_account(db: Database, account_id: str, change: AccountChange) -> Account:
    """Give an account another role, close it, or open it again. Its sessions and tokens follow at once.

    Raises:
        NotFound: there is no such account.
        Refused: nobody would be left who can sign in as admin.
    """
    with db.write() as conn:
        take_turn(conn, ACCESS_TURN)
        row = _row(conn, account_id)
        values: dict[str, object] = {}
        if change.role is not None:
            values["role"] = change.role
        if change.disabled is not None:
            values["disabled_at"] = (row.disabled_at or current_time(conn)) if change.disabled else None
        had_admin = has_admin(conn)
        if values:
            conn.execute(update(accounts).where(accounts.c.id == account_id).values(values))
        if had_admin and not has_admin(conn):
            raise Refused(f"'{row.name}' is the only admin who can sign in; make somebody else an admin first.")
        return account_of(_row(conn, account_id))


def has_admin(conn: Connection) -> bool:
    """Tell whether anybody can sign in as admin."""
    query = (
        select(func.count())
        .select_from(accounts)
        .where(accounts.c.role == "admin", accounts.c.password_hash.is_not(None), accounts.c.disabled_at.is_(None))
    )
    return conn.execute(query).scalar_one() > 0


def insert_account(conn: Connection, name: str, role: Role) -> Account:
    """Insert a row within a transaction and return it."""
    values = {"id": uuid.uuid4().hex, "name": name, "role": role, "created_at": current_time(conn)}
    return account_of(conn.execute(insert(accounts).values(values).returning(*accounts.c)).one())


def account_of(row: AnyRow) -> Account:
    """Return a row of accounts as a record."""
    return Account(row.id, row.name, row.role, row.password_hash is not None, row.created_at, row.disabled_at)


def _row(conn: Connection, account_id: str) -> AnyRow:
    row = conn.execute(select(accounts).where(accounts.c.id == account_id)).one_or_none()
    if row is None:
        raise NotFound("account", account_id)
    return row
