"""Who asks: a browser with a session, or a program with a token."""

from __future__ import annotations

import hmac
from dataclasses import dataclass
from hashlib import sha256

from starlette.requests import HTTPConnection

from backend.api.access.passwords import Passwords
from backend.api.access.recent_callers import RecentCallers
from backend.api.access.throttle import Throttle
from backend.api.access.tickets import Tickets, opens_by_ticket
from backend.store.access import api_tokens, login_sessions
from backend.store.access.accounts import Account
from backend.store.access.entry import LOCAL_NAME, AccessMode
from backend.store.access.local_token import load_local_token
from backend.store.access.roles import Role, allows, lesser
from backend.store.database import Database
from backend.store.settings import Settings


@dataclass(frozen=True)
class Access:
    """Hold what decides who comes in, as long as the application lives."""

    mode: AccessMode
    cookie: str
    """Name of the session's cookie: cookies are shared between ports, so each data directory has a name of its own."""
    local_token: str
    passwords: Passwords
    throttle: Throttle
    tickets: Tickets
    recent: RecentCallers


@dataclass(frozen=True)
class Caller:
    """Say who asks and what they may do."""

    name: str
    role: Role
    account_id: str | None
    """None: whoever came with the token of a server on loopback."""
    session_id: str | None
    """The browser's session; None: a program."""
    token: api_tokens.ApiToken | None = None
    """What a program has shown; None: a browser, or a program with the token of a server on loopback."""
    is_narrow: bool = False
    """Whether it is a program that may do less than its owner."""


TICKET_HOLDER = Caller("a ticket", "viewer", None, None)
"""Whoever shows a ticket may read the one address that it opens."""


@dataclass(frozen=True)
class Refusal:
    """Say why nobody is known to ask, in one sentence."""

    message: str


NOTHING_SHOWN = {
    "token": Refusal("Sign in first: open the address that 'sldr serve' printed, or send its token."),
    "accounts": Refusal("Sign in first, or send an API token."),
}
SESSION_OVER = Refusal("Your session has ended; sign in again.")
TOKEN_VOID = Refusal("This token opens nothing: it is unknown, expired or revoked.")


def open_access(settings: Settings, secret: bytes, mode: AccessMode, passwords: Passwords) -> Access:
    """Return what decides who comes in over a data directory."""
    cookie = f"sldr_session_{sha256(secret + b'cookie').hexdigest()[:8]}"
    return Access(mode, cookie, load_local_token(settings), passwords, Throttle(), Tickets(secret), RecentCallers())


def find_caller(access: Access, db: Database, connection: HTTPConnection) -> Caller | Refusal:
    """Return who asks, or why that is not known."""
    shown = connection.headers.get("authorization")
    if shown is not None:
        return _find_by_token(access, db, shown)
    if opens_by_ticket(access.tickets, connection):
        return TICKET_HOLDER
    secret = connection.cookies.get(access.cookie)
    return NOTHING_SHOWN[access.mode] if secret is None else _find_by_session(access, db, secret)


def _find_by_token(access: Access, db: Database, shown: str) -> Caller | Refusal:
    scheme, _, secret = shown.partition(" ")
    if scheme.lower() != "bearer":
        return TOKEN_VOID
    secret = secret.strip()
    if access.mode == "token" and is_local_token(access, secret):
        return Caller(LOCAL_NAME, "admin", None, None)
    found = api_tokens.find_token(db, secret)
    if found is None or not _may_come_in(access, found[1]):
        return TOKEN_VOID
    token, account = found
    if account is None:
        return Caller(LOCAL_NAME, token.role, None, None, token, is_narrow=token.role != "admin")
    is_narrow = not allows(token.role, account.role)
    return Caller(account.name, lesser(token.role, account.role), account.id, None, token, is_narrow)


def _find_by_session(access: Access, db: Database, secret: str) -> Caller | Refusal:
    found = login_sessions.find_session(db, secret)
    if found is None or not _may_come_in(access, found[1]):
        return SESSION_OVER
    session, account = found
    if account is None:
        return Caller(LOCAL_NAME, "admin", None, session.id)
    return Caller(account.name, account.role, account.id, session.id)


def is_local_token(access: Access, secret: str) -> bool:
    """Tell whether a secret is the token of this server on loopback."""
    return hmac.compare_digest(secret.encode(errors="surrogatepass"), access.local_token.encode())


def _may_come_in(access: Access, account: Account | None) -> bool:
    """Tell whether an owner counts: what was given out on loopback opens nothing where accounts are required."""
    return account is not None or access.mode == "token"
