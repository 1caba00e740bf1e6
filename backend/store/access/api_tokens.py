"""Tokens for programs: each may do no more than its role, and no more than its owner may."""

from __future__ import annotations

import uuid
from dataclasses import dataclass
from datetime import datetime, timedelta

from sqlalchemy import ColumnElement, and_, func, insert, or_, select, update

from backend.store.access.accounts import Account
from backend.store.access.login_sessions import TOUCH_INTERVAL
from backend.store.access.owners import belongs_to, read_with_owner
from backend.store.access.roles import Role
from backend.store.access.secret_tokens import hash_token, new_secret_token
from backend.store.access.tables import api_tokens
from backend.store.database import Database, current_time
from backend.store.errors import NotFound, Refused
from backend.store.tables import AnyRow

TOKENS_AT_MOST = 50
"""Valid tokens of one account."""


@dataclass(frozen=True)
class ApiToken:
    """Describe one token, without its secret."""

    id: str
    account_id: str | None
    """None: it was made on a server on loopback, before there were accounts."""
    name: str
    role: Role
    created_at: datetime
    expires_at: datetime | None
    used_at: datetime | None


def create_token(
    db: Database, account_id: str | None, name: str, role: Role, lifetime: timedelta | None
) -> tuple[ApiToken, str]:
    """Make a token; return it with its secret, which is not kept.

    Args:
        lifetime: how long it is valid; None: until it is revoked.

    Raises:
        Refused: the account has too many.
    """
    token = new_secret_token()
    with db.write() as conn:
        at = current_time(conn)
        valid = (
            select(func.count())
            .select_from(api_tokens)
            .where(belongs_to(api_tokens.c.account_id, account_id), _is_valid(at))
        )
        if conn.execute(valid).scalar_one() >= TOKENS_AT_MOST:
            raise Refused(f"There are {TOKENS_AT_MOST} tokens already; revoke one that is not used any more.")
        values = {
            "id": uuid.uuid4().hex,
            "token_hash": hash_token(token),
            "account_id": account_id,
            "name": name,
            "role": role,
            "created_at": at,
            "expires_at": None if lifetime is None else at + lifetime,
        }
        row = conn.execute(insert(api_tokens).values(values).returning(*api_tokens.c)).one()
    return _token(row), token


def find_token(db: Database, token: str) -> tuple[ApiToken, Account | None] | None:
    """Return the token that a secret belongs to with its account, and note that it was used; None if it is over."""
    with db.read() as conn:
        at = current_time(conn)
        query = select(api_tokens).where(api_tokens.c.token_hash == hash_token(token), _is_valid(at))
        found = read_with_owner(conn, query)
    if found is None:
        return None
    row, owner = found
    if row.used_at is None or at - row.used_at >= TOUCH_INTERVAL:
        db.note(update(api_tokens).where(api_tokens.c.id == row.id).values(used_at=at))
    return _token(row), owner


def list_tokens(db: Database, account_id: str | None) -> list[ApiToken]:
    """Return the valid tokens of an account, the newest first."""
    with db.read() as conn:
        query = (
            select(api_tokens)
            .where(belongs_to(api_tokens.c.account_id, account_id), _is_valid(current_time(conn)))
            .order_by(api_tokens.c.created_at.desc())
        )
        return [_token(row) for row in conn.execute(query)]


def revoke_token(db: Database, account_id: str | None, token_id: str) -> None:
    """Let a token open nothing any more.

    Raises:
        NotFound: the account has no such token.
    """
    with db.write() as conn:
        at = current_time(conn)
        this = and_(api_tokens.c.id == token_id, belongs_to(api_tokens.c.account_id, account_id), _is_valid(at))
        if conn.execute(update(api_tokens).where(this).values(revoked_at=at)).rowcount == 0:
            raise NotFound("token", token_id)


def _is_valid(at: datetime) -> ColumnElement[bool]:
    ends = api_tokens.c.expires_at
    return and_(api_tokens.c.revoked_at.is_(None), or_(ends.is_(None), ends > at))


def _token(row: AnyRow) -> ApiToken:
    return ApiToken(row.id, row.account_id, row.name, row.role, row.created_at, row.expires_at, row.used_at)
