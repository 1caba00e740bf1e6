"""Everybody's accounts and the audit log, for admins."""

from __future__ import annotations

from dataclasses import asdict
from typing import Annotated

from fastapi import APIRouter, Query

from backend.api.access.declarations import needs
from backend.api.access_schemas import (
    AccountInfo,
    Accounts,
    AccountUpdate,
    AuditRecord,
    AuditRecords,
    InvitationLink,
    NewAccount,
)
from backend.api.dependencies import Store
from backend.api.errors import ApiError, problem_responses
from backend.store.access import audit, invitations
from backend.store.access.accounts import (
    Account,
    AccountChange,
    change_account,
    create_account,
    get_account,
    list_accounts,
)
from backend.store.access.entry import RESERVED_NAMES, WELCOME
from backend.store.database import Database
from backend.store.schema import NAME_LENGTH

LARGEST_PAGE = 500
"""Entries of the audit log in one answer at most."""

LARGEST_ID = 2**31 - 1
"""Entries are numbered with 32 bits."""

router = APIRouter(prefix="/api", tags=["access"])


@router.get("/accounts", responses=problem_responses())
@needs("admin")
def list_all_accounts(store: Store) -> Accounts:
    """List every account."""
    return Accounts(accounts=[_info(account) for account in list_accounts(store)])


@router.post("/accounts", status_code=201, responses=problem_responses(400, 403, 409, 422))
@needs("admin")
def add_account(wish: NewAccount, store: Store) -> InvitationLink:
    """Make an account, and a one-time link with which its owner sets the password."""
    if wish.name in RESERVED_NAMES:
        raise ApiError(422, f"'{wish.name}' stands for something else; choose another name.", "name")
    return _link(store, create_account(store, wish.name, wish.role))


@router.patch("/accounts/{account_id}", responses=problem_responses(400, 403, 404, 409, 422))
@needs("admin")
def update_account(account_id: str, wish: AccountUpdate, store: Store) -> AccountInfo:
    """Give an account another role, close it or open it again; its sessions and tokens follow at once."""
    return _info(change_account(store, account_id, AccountChange(wish.role, wish.disabled)))


@router.post("/accounts/{account_id}/invitation", status_code=201, responses=problem_responses(403, 404, 409, 422))
@needs("admin")
def invite_again(account_id: str, store: Store) -> InvitationLink:
    """Make a new one-time link, for a forgotten password too; the present one stays until the link is used."""
    return _link(store, get_account(store, account_id))


@router.get("/audit", responses=problem_responses(422))
@needs("admin")
def list_audit_log(
    store: Store,
    limit: Annotated[int, Query(ge=1, le=LARGEST_PAGE)] = 100,
    before: Annotated[
        int | None, Query(ge=1, le=LARGEST_ID, description="`next` of the page before; left out: the newest.")
    ] = None,
    who: Annotated[str | None, Query(max_length=NAME_LENGTH, description="Only what this one did.")] = None,
    outcome: Annotated[audit.Outcome | None, Query(description="Only what ended so.")] = None,
) -> AuditRecords:
    """List who did what, when, from where, and what came of it."""
    found = audit.list_entries(store, limit, before, who, outcome)
    entries = [AuditRecord(id=entry.id, at=entry.at, **asdict(entry.deed)) for entry in found]
    return AuditRecords(entries=entries, next=found[-1].id if len(found) == limit else None)


def _link(store: Database, account: Account) -> InvitationLink:
    token, ends_at = invitations.invite(store, account.id)
    return InvitationLink(account=_info(account), path=f"{WELCOME}{token}", expires_at=ends_at)


def _info(account: Account) -> AccountInfo:
    return AccountInfo(**asdict(account))
