"""One's own account: its password, the browsers that are signed in to it, its tokens for programs."""

from __future__ import annotations

from dataclasses import asdict
from datetime import timedelta

from fastapi import APIRouter, Request

from backend.api.access.declarations import needs
from backend.api.access.passwords import find_weakness
from backend.api.access.trail import client_address
from backend.api.access_schemas import (
    CreatedToken,
    NewToken,
    PasswordChange,
    SessionInfo,
    Sessions,
    TokenInfo,
    Tokens,
)
from backend.api.dependencies import KnownCaller, ServiceParts, Store
from backend.api.errors import ApiError, problem_responses
from backend.store.access import accounts, api_tokens, login_sessions
from backend.store.access.roles import allows

router = APIRouter(prefix="/api/account", tags=["access"])


@router.put("/password", status_code=204, responses=problem_responses(400, 403, 409, 422, 429))
@needs("viewer", audited=True)
def change_password(wish: PasswordChange, request: Request, caller: KnownCaller, service: ServiceParts) -> None:
    """Replace one's password; every other browser is signed out."""
    if caller.account_id is None or caller.session_id is None:
        raise ApiError(409, "Only somebody who is signed in to an account can change its password.")
    address = client_address(request.scope)
    if service.access.throttle.admit(caller.name, address):
        raise ApiError(429, "Too many attempts have failed; try again in some minutes.")
    found = accounts.find_password(service.database, caller.name)
    if not service.access.passwords.matches(found[1] if found else None, wish.old):
        raise ApiError(403, "This is not your present password.", "old")
    service.access.throttle.forgive(caller.name, address)
    weakness = find_weakness(caller.name, wish.new)
    if weakness:
        raise ApiError(422, weakness, "new")
    accounts.set_password(service.database, caller.account_id, service.access.passwords.hash(wish.new))
    login_sessions.end_other_sessions(service.database, caller.account_id, caller.session_id)


@router.get("/sessions", responses=problem_responses())
@needs("viewer")
def list_own_sessions(caller: KnownCaller, store: Store) -> Sessions:
    """List the browsers that are signed in to one's account."""
    found = login_sessions.list_sessions(store, caller.account_id)
    return Sessions(
        sessions=[
            SessionInfo(
                id=session.id,
                created_at=session.created_at,
                seen_at=session.seen_at,
                expires_at=session.expires_at,
                address=session.address,
                agent=session.agent,
                is_this=session.id == caller.session_id,
            )
            for session in found
        ]
    )


@router.delete("/sessions/{session_id}", status_code=204, responses=problem_responses(403, 404, 422))
@needs("viewer", audited=True)
def end_own_session(session_id: str, caller: KnownCaller, store: Store) -> None:
    """Sign a browser out of one's account."""
    if caller.is_narrow:
        raise ApiError(403, "This token may do less than its owner, so it ends no session; sign in to end one.")
    login_sessions.end_session(store, caller.account_id, session_id)


@router.get("/tokens", responses=problem_responses())
@needs("viewer")
def list_own_tokens(caller: KnownCaller, store: Store) -> Tokens:
    """List one's tokens for programs."""
    return Tokens(tokens=[_token(token) for token in api_tokens.list_tokens(store, caller.account_id)])


@router.post("/tokens", status_code=201, responses=problem_responses(400, 403, 409, 422))
@needs("viewer", audited=True)
def create_own_token(wish: NewToken, caller: KnownCaller, store: Store) -> CreatedToken:
    """Make a token for a program; its secret is shown this once. A program makes none with a token of its own."""
    if caller.token is not None:
        raise ApiError(403, "A token makes no tokens, which would outlive it; sign in to make one.")
    if not allows(caller.role, wish.role):
        raise ApiError(403, f"A token may not do more than you: choose {caller.role} or less.", "role")
    lifetime = None if wish.days is None else timedelta(days=wish.days)
    token, secret = api_tokens.create_token(store, caller.account_id, wish.name.strip(), wish.role, lifetime)
    return CreatedToken(token=_token(token), secret=secret)


@router.delete("/tokens/{token_id}", status_code=204, responses=problem_responses(403, 404, 422))
@needs("viewer", audited=True)
def revoke_own_token(token_id: str, caller: KnownCaller, store: Store) -> None:
    """Let a token open nothing any more."""
    if caller.is_narrow and (caller.token is None or token_id != caller.token.id):
        raise ApiError(403, "This token may do less than its owner, so it revokes only itself; sign in for others.")
    api_tokens.revoke_token(store, caller.account_id, token_id)


def _token(token: api_tokens.ApiToken) -> TokenInfo:
    values = asdict(token)
    del values["account_id"]
    return TokenInfo(**values)
