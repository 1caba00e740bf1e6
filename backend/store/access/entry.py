"""How people come in: with a token where only this machine can ask, with accounts everywhere else."""

from __future__ import annotations

from contextlib import closing
from typing import Literal

from backend.store.access.invitations import LINK_LIFETIME, invite_first_admin
from backend.store.access.local_token import load_local_token
from backend.store.database import open_database
from backend.store.settings import Settings

AccessMode = Literal["token", "accounts"]
"""The token of a server on loopback, or accounts with passwords."""

LOOPBACK = frozenset({"127.0.0.1", "localhost", "::1"})
"""Bound to one of these, a server is reached from its own machine only."""

ACCOUNT_NAME = r"^[a-z0-9][a-z0-9._-]{0,63}$"
"""What an account may be called."""

LOCAL_NAME = "local"
"""Stands for whoever came with the token of a server on loopback."""

NOBODY = "nobody"
"""Stands for whoever is not known."""

RESERVED_NAMES = frozenset({LOCAL_NAME, NOBODY})
"""No account has one of these names."""

WELCOME = "/welcome#"
"""Where a one-time link leads. Its secret stands behind the hash: browsers never send that, so no log holds it."""


def choose_mode(host: str, accounts: bool = False) -> AccessMode:
    """Return how people come in at a server that listens on `host`; accounts can be asked for anywhere."""
    return "token" if host in LOOPBACK and not accounts else "accounts"


def greet(settings: Settings, address: str, mode: AccessMode) -> str:
    """Return where to go in, for whoever has started the server: with the token, or with a link for the first admin.

    Args:
        settings: the data directory.
        address: where the server answers, without a path.
        mode: how people come in.
    """
    if mode == "token":
        return f"SLDR is at {address}/?token={load_local_token(settings)}"
    with closing(open_database(settings)) as database:
        secret = invite_first_admin(database)
    if secret is None:
        return f"SLDR is at {address}"
    link = f"{address}{WELCOME}{secret}"
    return f"SLDR is at {address}\nThere is no admin yet. Open this once, within {LINK_LIFETIME.days} days: {link}\n"
