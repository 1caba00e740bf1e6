"""One-time links: with one, the owner of an account sets its password, the first time or when it is forgotten."""

from __future__ import annotations

from datetime import datetime, timedelta

from sqlalchemy import Connection, insert, select, update

from backend.store.access.accounts import ACCESS_TURN, Account, account_of, has_admin, insert_account
from backend.store.access.login_sessions import end_all
from backend.store.access.secret_tokens import hash_token, new_secret_token
from backend.store.access.tables import accounts, invitations
from backend.store.database import Database, current_time, take_turn
from backend.store.errors import NotFound, Refused
from backend.store.tables import AnyRow

LINK_LIFETIME = timedelta(days=3)
"""How long a link can be opened."""

FIRST_ADMIN = "admin"
"""Name of the account that is made when there is none."""


def invite(db: Database, account_id: str) -> tuple[str, datetime]:
    """Make a link for an account and return its secret and its end; earlier links of the account open nothing any more.

    Raises:
        NotFound: there is no such account.
        Refused: it is closed, so that the link would open nothing.
    """
    with db.write() as conn:
        row = conn.execute(select(accounts).where(accounts.c.id == account_id)).one_or_none()
        if row is None:
            raise NotFound("account", account_id)
        if row.disabled_at is not None:
            raise Refused(f"The account '{row.name}' is closed; open it again first.")
        return _invite(conn, account_id)


def invite_first_admin(db: Database) -> str | None:
    """Return the secret of a link for the first admin, or None if somebody can sign in as admin already."""
    with db.write() as conn:
        take_turn(conn, ACCESS_TURN)
        if has_admin(conn):
            return None
        row = conn.execute(select(accounts).where(accounts.c.name == FIRST_ADMIN)).one_or_none()
        account_id = row.id if row else insert_account(conn, FIRST_ADMIN, "admin").id
        conn.execute(update(accounts).where(accounts.c.id == account_id).values(role="admin", disabled_at=None))
        return _invite(conn, account_id)[0]


def find_invited(db: Database, token: str) -> Account:
    """Return the account that a link is for.

    Raises:
        Refused: the link opens nothing.
    """
    with db.read() as conn:
        return account_of(_invited(conn, token))


def accept(db: Database, token: str, password_hash: str) -> Account:
    """Use a link up: its account has this password from now on, and everybody who was signed in to it is not any more.

    Raises:
        Refused: the link opens nothing.
    """
    with db.write() as conn:
        row = _invited(conn, token)
        at = current_time(conn)
        this = (invitations.c.token_hash == hash_token(token), invitations.c.used_at.is_(None))
        if conn.execute(update(invitations).where(*this).values(used_at=at)).rowcount == 0:
            raise _opens_nothing()
        conn.execute(update(accounts).where(accounts.c.id == row.id).values(password_hash=password_hash))
        end_all(conn, row.id)
        return account_of(conn.execute(select(accounts).where(accounts.c.id == row.id)).one())


def _invite(conn: Connection, account_id: str) -> tuple[str, datetime]:
    at = current_time(conn)
    earlier = (invitations.c.account_id == account_id, invitations.c.used_at.is_(None))
    conn.execute(update(invitations).where(*earlier).values(used_at=at))
    token, ends_at = new_secret_token(), at + LINK_LIFETIME
    values = {"token_hash": hash_token(token), "account_id": account_id, "created_at": at, "expires_at": ends_at}
    conn.execute(insert(invitations).values(values))
    return token, ends_at


def _invited(conn: Connection, token: str) -> AnyRow:
    query = (
        select(accounts)
        .join(invitations, invitations.c.account_id == accounts.c.id)
        .where(
            invitations.c.token_hash == hash_token(token),
            invitations.c.used_at.is_(None),
            invitations.c.expires_at > current_time(conn),
            accounts.c.disabled_at.is_(None),
        )
    )
    row = conn.execute(query).one_or_none()
    if row is None:
        raise _opens_nothing()
    return row


def _opens_nothing() -> Refused:
    return Refused("This link was used already, has expired or was never valid; ask an admin for a new one.")
