"""The API's records about who may use it: signing in, accounts, sessions, tokens, the audit log."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated

from pydantic import Field

from backend.api.access.passwords import LONGEST_PASSWORD
from backend.api.schemas import Strict
from backend.store.access.audit import Outcome
from backend.store.access.entry import ACCOUNT_NAME, AccessMode
from backend.store.access.roles import Role
from backend.store.schema import NAME_LENGTH

LONGEST_SECRET = 500
"""Characters of a secret that is shown to the server."""

MOST_DAYS = 3650
"""Longest life of a token [days]."""

AccountName = Annotated[str, Field(pattern=ACCOUNT_NAME, description="Small letters, digits, . _ -")]
Password = Annotated[str, Field(min_length=1, max_length=LONGEST_PASSWORD)]
Secret = Annotated[str, Field(min_length=1, max_length=LONGEST_SECRET)]
TokenName = Annotated[str, Field(min_length=1, max_length=NAME_LENGTH, pattern=r"\S")]


class CallerInfo(Strict):
    """Who asks."""

    name: str
    role: Role
    has_account: bool = Field(description="False: came with the token of a server on loopback.")


class Me(Strict):
    """How people come in here, and who asks."""

    mode: AccessMode
    caller: CallerInfo | None = Field(description="Null: nobody is signed in.")
    message: str | None = Field(description="Why nobody is.")


class TokenEntry(Strict):
    """The token that `sldr serve` has printed."""

    token: Secret


class SignIn(Strict):
    """An account and its password."""

    name: Annotated[str, Field(min_length=1, max_length=NAME_LENGTH)]
    password: Password


class InvitationLook(Strict):
    """The secret of a one-time link."""

    token: Secret


class InvitationAccept(Strict):
    """The secret of a one-time link, and the password to set."""

    token: Secret
    password: Password


class Invited(Strict):
    """The account that a one-time link is for."""

    name: str
    role: Role


class PasswordChange(Strict):
    """The password of one's own account, and the next one."""

    old: Password
    new: Password


class SessionInfo(Strict):
    """One browser that is signed in."""

    id: str
    created_at: datetime
    seen_at: datetime
    expires_at: datetime
    address: str
    agent: str = Field(description="What the browser says it is.")
    is_this: bool = Field(description="Whether it is the one that asks.")


class Sessions(Strict):
    """The browsers that are signed in to one's own account."""

    sessions: list[SessionInfo]


class NewToken(Strict):
    """A token to be made for a program."""

    name: TokenName
    role: Role = Field(description="What it may do at most; never more than its owner.")
    days: Annotated[int, Field(ge=1, le=MOST_DAYS)] | None = Field(
        90, description="Its life; null: until revoked. One that a token makes ends with that at the latest."
    )


class TokenInfo(Strict):
    """One token, without its secret."""

    id: str
    name: str
    role: Role
    created_at: datetime
    expires_at: datetime | None
    used_at: datetime | None


class CreatedToken(Strict):
    """A new token with its secret, which is shown this once."""

    token: TokenInfo
    secret: str


class Tokens(Strict):
    """One's own tokens."""

    tokens: list[TokenInfo]


class NewAccount(Strict):
    """An account to be made; its owner sets the password."""

    name: AccountName
    role: Role


class AccountInfo(Strict):
    """One account."""

    id: str
    name: str
    role: Role
    has_password: bool = Field(description="Whether its owner has opened the link and set one.")
    created_at: datetime
    disabled_at: datetime | None


class Accounts(Strict):
    """Every account."""

    accounts: list[AccountInfo]


class AccountUpdate(Strict):
    """What changes of an account; what is left out or null stays."""

    role: Role | None = None
    disabled: bool | None = None


class InvitationLink(Strict):
    """A one-time link for the owner of an account: hand it over in private, it is shown this once."""

    account: AccountInfo
    path: str = Field(description="Path of this server, to be opened in a browser.")
    expires_at: datetime


class AuditRecord(Strict):
    """One entry of the audit log."""

    id: int
    at: datetime
    who: str
    action: str
    target: str | None
    address: str
    outcome: Outcome
    detail: str | None


class AuditRecords(Strict):
    """A page of the audit log, the newest entry first."""

    entries: list[AuditRecord]
    next: int | None = Field(description="`before` of the next page; null: there is none.")
