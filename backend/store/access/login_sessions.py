"""Browsers that are signed in: each has a secret in a cookie, and is known here by the secret's hash."""

from __future__ import annotations

import uuid
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any

from sqlalchemy import BindParameter, ColumnElement, Connection, and_, bindparam, insert, select, update

from backend.store.access.accounts import Account
from backend.store.access.owners import belongs_to, read_with_owner
from backend.store.access.secret_tokens import hash_token, new_secret_token
from backend.store.access.tables import login_sessions
from backend.store.database import Database, current_time
from backend.store.errors import NotFound
from backend.store.schema import NAME_LENGTH
from backend.store.tables import AnyRow

SESSION_LIFETIME = timedelta(days=30)
"""How long after signing in a session ends whatever happens."""

IDLE_LIFETIME = timedelta(days=3)
"""How long after its last request a session ends."""

TOUCH_INTERVAL = timedelta(minutes=1)
"""How exactly the last request is known: it is written down no more often."""


@dataclass(frozen=True)
class LoginSession:
    """Describe one browser that is signed in."""

    id: str
    account_id: str | None
    """None: it came with the token of a server on loopback."""
    created_at: datetime
    seen_at: datetime
    expires_at: datetime
    address: str
    agent: str
    """What the browser says it is."""


def _is_open(at: datetime | BindParameter[Any], idle_since: datetime | BindParameter[Any]) -> ColumnElement[bool]:
    return and_(
        login_sessions.c.ended_at.is_(None),
        login_sessions.c.expires_at > at,
        login_sessions.c.seen_at > idle_since,
    )


_BY_TOKEN = select(login_sessions).where(
    login_sessions.c.token_hash == bindparam("token_hash"), _is_open(bindparam("at"), bindparam("idle_since"))
)
"""Made once: it is asked for at nearly every request, and making it takes longer than running it."""


def start_session(db: Database, account_id: str | None, address: str, agent: str) -> tuple[LoginSession, str]:
    """Sign a browser in; return its session and the secret for its cookie."""
    token = new_secret_token()
    with db.write() as conn:
        at = current_time(conn)
        values = {
            "id": uuid.uuid4().hex,
            "token_hash": hash_token(token),
            "account_id": account_id,
            "created_at": at,
            "seen_at": at,
            "expires_at": at + SESSION_LIFETIME,
            "address": address[:NAME_LENGTH],
            "agent": agent[:NAME_LENGTH],
        }
        row = conn.execute(insert(login_sessions).values(values).returning(*login_sessions.c)).one()
    return _session(row), token


def find_session(db: Database, token: str) -> tuple[LoginSession, Account | None] | None:
    """Return the session that a secret belongs to with its account, and note that it was used; None if it is over."""
    with db.read() as conn:
        at = current_time(conn)
        found = read_with_owner(
            conn, _BY_TOKEN, {"token_hash": hash_token(token), "at": at, "idle_since": at - IDLE_LIFETIME}
        )
    if found is None:
        return None
    row, owner = found
    if at - row.seen_at >= TOUCH_INTERVAL:
        db.note(update(login_sessions).where(login_sessions.c.id == row.id).values(seen_at=at))
    return _session(row), owner


def list_sessions(db: Database, account_id: str | None) -> list[LoginSession]:
    """Return the open sessions of an account, the one used last first."""
    with db.read() as conn:
        query = (
            select(login_sessions)
            .where(belongs_to(login_sessions.c.account_id, account_id), _is_open_at(current_time(conn)))
            .order_by(login_sessions.c.seen_at.desc())
        )
        return [_session(row) for row in conn.execute(query)]


def end_session(db: Database, account_id: str | None, session_id: str) -> None:
    """Sign a browser out.

    Raises:
        NotFound: the account has no such session.
    """
    with db.write() as conn:
        at = current_time(conn)
        this = and_(
            login_sessions.c.id == session_id, belongs_to(login_sessions.c.account_id, account_id), _is_open_at(at)
        )
        if conn.execute(update(login_sessions).where(this).values(ended_at=at)).rowcount == 0:
            raise NotFound("session", session_id)


def end_other_sessions(db: Database, account_id: str | None, kept: str | None) -> None:
    """Sign every browser of an account out but one."""
    with db.write() as conn:
        end_all(conn, account_id, kept)


def end_all(conn: Connection, account_id: str | None, kept: str | None = None) -> None:
    """Sign every browser of an account out, but one if it is named, within a transaction."""
    at = current_time(conn)
    these = and_(belongs_to(login_sessions.c.account_id, account_id), _is_open_at(at))
    if kept is not None:
        these = and_(these, login_sessions.c.id != kept)
    conn.execute(update(login_sessions).where(these).values(ended_at=at))


def _is_open_at(at: datetime) -> ColumnElement[bool]:
    return _is_open(at, at - IDLE_LIFETIME)


def _session(row: AnyRow) -> LoginSession:
    return LoginSession(row.id, row.account_id, row.created_at, row.seen_at, row.expires_at, row.address, row.agent)
