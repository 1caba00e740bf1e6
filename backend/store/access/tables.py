"""The tables of who may use the service, and of what was done with it."""

from __future__ import annotations

from sqlalchemy import Column, ForeignKey, Integer, String, Table, Text

from backend.store.schema import HASH_LENGTH, ID_LENGTH, NAME_LENGTH, UtcDateTime, metadata

ACCOUNT_NAME_LENGTH = 64

accounts = Table(
    "accounts",
    metadata,
    Column("id", String(ID_LENGTH), primary_key=True),
    Column("name", String(ACCOUNT_NAME_LENGTH), nullable=False, unique=True),
    Column("role", String(ID_LENGTH), nullable=False),
    Column("password_hash", Text),
    Column("created_at", UtcDateTime, nullable=False),
    Column("disabled_at", UtcDateTime),
)
"""Who may sign in. Without a password an account waits for its owner to open the link that was made for it."""

invitations = Table(
    "invitations",
    metadata,
    Column("token_hash", String(HASH_LENGTH), primary_key=True),
    Column("account_id", String(ID_LENGTH), ForeignKey("accounts.id"), nullable=False, index=True),
    Column("created_at", UtcDateTime, nullable=False),
    Column("expires_at", UtcDateTime, nullable=False),
    Column("used_at", UtcDateTime),
)
"""One-time links with which the owner of an account sets its password."""

login_sessions = Table(
    "login_sessions",
    metadata,
    Column("id", String(ID_LENGTH), primary_key=True),
    Column("token_hash", String(HASH_LENGTH), nullable=False, unique=True),
    Column("account_id", String(ID_LENGTH), ForeignKey("accounts.id"), index=True),
    Column("created_at", UtcDateTime, nullable=False),
    Column("seen_at", UtcDateTime, nullable=False),
    Column("expires_at", UtcDateTime, nullable=False),
    Column("ended_at", UtcDateTime),
    Column("address", String(NAME_LENGTH), nullable=False),
    Column("agent", String(NAME_LENGTH), nullable=False),
)
"""Browsers that are signed in; those without an account came with the token of a server on loopback."""

api_tokens = Table(
    "api_tokens",
    metadata,
    Column("id", String(ID_LENGTH), primary_key=True),
    Column("token_hash", String(HASH_LENGTH), nullable=False, unique=True),
    Column("account_id", String(ID_LENGTH), ForeignKey("accounts.id"), index=True),
    Column("name", String(NAME_LENGTH), nullable=False),
    Column("role", String(ID_LENGTH), nullable=False),
    Column("created_at", UtcDateTime, nullable=False),
    Column("expires_at", UtcDateTime),
    Column("used_at", UtcDateTime),
    Column("revoked_at", UtcDateTime),
)

audit_log = Table(
    "audit_log",
    metadata,
    Column("id", Integer, primary_key=True, autoincrement=True),
    Column("at", UtcDateTime, nullable=False, index=True),
    Column("who", String(NAME_LENGTH), nullable=False),
    Column("action", String(NAME_LENGTH), nullable=False),
    Column("target", String(NAME_LENGTH)),
    Column("address", String(NAME_LENGTH), nullable=False),
    Column("outcome", String(ID_LENGTH), nullable=False),
    Column("detail", Text),
)
