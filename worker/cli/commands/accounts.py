"""`sldr accounts`: who may sign in, and a one-time link for whoever cannot."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import closing

import tyro

from backend.store.access.accounts import Account, AccountChange, change_account, create_account, list_accounts
from backend.store.access.audit import Deed, write_entry
from backend.store.access.entry import ACCOUNT_NAME, RESERVED_NAMES, WELCOME
from backend.store.access.invitations import LINK_LIFETIME
from backend.store.access.invitations import invite as make_link
from backend.store.access.roles import Role
from backend.store.database import Database, open_database
from backend.store.settings import load_settings
from sldr_core.errors import InvalidConfig

WHO = "command line"
"""Stands in the audit log for whoever may write into the store anyway."""


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(accounts, prog="sldr accounts", args=list(arguments))


def accounts(invite: str | None = None, role: Role | None = None, close: str | None = None) -> int:
    """List the accounts, or make a one-time link with which the owner of one sets its password.

    Args:
        invite: Name of the account to make a link for; it is made if there is none.
        role: Its role; a new account without one is a viewer.
        close: Name of the account that nobody may sign in to any more.
    """
    if role is not None and invite is None:
        raise InvalidConfig({"role": "whose it is to be is not said; name the account with --invite"})
    with closing(open_database(load_settings())) as db:
        if close is not None:
            change_account(db, _find(db, close).id, AccountChange(disabled=True))
            _tell(db, "close account", close)
        if invite is not None:
            print(_invite(db, invite, role))
        for account in list_accounts(db):
            print(f"{account.name:20} {account.role:10} {_state(account)}")
    return 0


def _invite(db: Database, name: str, role: Role | None) -> str:
    if not re.fullmatch(ACCOUNT_NAME, name) or name in RESERVED_NAMES:
        raise InvalidConfig({"invite": f"'{name}' cannot be a name; use small letters, digits and . _ -"})
    known = {account.name: account for account in list_accounts(db)}
    account = known.get(name) or create_account(db, name, role or "viewer")
    change_account(db, account.id, AccountChange(role=role, disabled=False))
    token, _ = make_link(db, account.id)
    _tell(db, "invite account", name)
    return f"Within {LINK_LIFETIME.days} days, {name} opens this once, at the address of the server: {WELCOME}{token}\n"


def _find(db: Database, name: str) -> Account:
    known = {account.name: account for account in list_accounts(db)}
    if name not in known:
        raise InvalidConfig({"close": f"there is no account '{name}'; there are: {', '.join(known) or 'none'}"})
    return known[name]


def _tell(db: Database, action: str, name: str) -> None:
    write_entry(db, Deed(WHO, action, "this machine", "done", name))


def _state(account: Account) -> str:
    if account.disabled_at is not None:
        return "closed"
    return "open" if account.has_password else "waits for its link to be opened"
