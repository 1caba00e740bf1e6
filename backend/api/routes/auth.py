"""Coming in and going out: with the token of a server on loopback, or with an account and its password."""

from __future__ import annotations

import math
from typing import Annotated

from fastapi import APIRouter, Query, Request, Response
from fastapi.responses import RedirectResponse

from backend.api.access.callers import Caller, is_local_token
from backend.api.access.declarations import needs, open_to_all
from backend.api.access.gate import caller_or_refusal
from backend.api.access.passwords import find_weakness
from backend.api.access.trail import client_address, record
from backend.api.access_schemas import (
    CallerInfo,
    InvitationAccept,
    InvitationLook,
    Invited,
    Me,
    SignIn,
    TokenEntry,
)
from backend.api.dependencies import KnownCaller, Service, ServiceParts
from backend.api.errors import ApiError, problem_responses
from backend.store.access import accounts, invitations, login_sessions
from backend.store.access.audit import Deed, Outcome
from backend.store.access.entry import LOCAL_NAME, NOBODY
from backend.store.errors import Refused

router = APIRouter(prefix="/api/auth", tags=["access"])

WRONG = "Name and password do not belong together."


@router.get("/me", responses=problem_responses())
@open_to_all
async def get_me(request: Request, service: ServiceParts) -> Me:
    """Tell how people come in here, and who asks."""
    found = await caller_or_refusal(request)
    if not isinstance(found, Caller):
        return Me(mode=service.access.mode, caller=None, message=found.message)
    info = CallerInfo(name=found.name, role=found.role, has_account=found.account_id is not None)
    return Me(mode=service.access.mode, caller=info, message=None)


@router.get("/enter", include_in_schema=False)
@open_to_all
def follow_link(request: Request, service: ServiceParts, token: Annotated[str, Query()] = "") -> Response:
    """Sign the browser in that opened the printed address, and lead it to an address without the token."""
    answer = RedirectResponse("/", 303)
    found = request.scope["state"]["caller"]
    if isinstance(found, Caller) and found.session_id is not None:
        return answer  # Opening the address again makes no second session.
    try:
        _check_local_token(service, request, token)
    except ApiError:
        return RedirectResponse("/sign-in?reason=token", 303)
    _start_session(service, request, answer, None, LOCAL_NAME)
    return answer


@router.post("/enter", status_code=204, responses=problem_responses(400, 403, 409, 422, 429))
@open_to_all
def enter(entry: TokenEntry, request: Request, response: Response, service: ServiceParts) -> None:
    """Sign a browser in with the token of a server on loopback."""
    _check_local_token(service, request, entry.token)
    _start_session(service, request, response, None, LOCAL_NAME)


@router.post("/sign-in", status_code=204, responses=problem_responses(400, 403, 422, 429))
@open_to_all
def sign_in(wish: SignIn, request: Request, response: Response, service: ServiceParts) -> None:
    """Sign a browser in with an account and its password."""
    name = wish.name.strip().lower()
    _admit(service, request, name)
    found = accounts.find_password(service.database, name)
    if not service.access.passwords.matches(found[1] if found else None, wish.password) or found is None:
        _tell(service, request, name, "sign in", "refused", "wrong name or password")
        raise ApiError(403, WRONG, "password")
    account, stored = found
    service.access.throttle.forgive(name, client_address(request.scope))
    if service.access.passwords.is_outdated(stored):
        accounts.set_password(service.database, account.id, service.access.passwords.hash(wish.password))
    _start_session(service, request, response, account.id, account.name)


@router.post("/invitation", responses=problem_responses(400, 403, 409, 422, 429))
@open_to_all
def look_at_invitation(look: InvitationLook, request: Request, service: ServiceParts) -> Invited:
    """Tell which account a one-time link is for."""
    account = _open_link(service, request, look.token)
    return Invited(name=account.name, role=account.role)


@router.post("/invitation/accept", status_code=204, responses=problem_responses(400, 403, 409, 422, 429))
@open_to_all
def accept_invitation(wish: InvitationAccept, request: Request, response: Response, service: ServiceParts) -> None:
    """Use a one-time link up: set the password of its account and sign the browser in."""
    account = _open_link(service, request, wish.token)
    weakness = find_weakness(account.name, wish.password)
    if weakness:
        raise ApiError(422, weakness, "password")
    invitations.accept(service.database, wish.token, service.access.passwords.hash(wish.password))
    _tell(service, request, account.name, "set password", "done", "with a one-time link")
    _start_session(service, request, response, account.id, account.name)


@router.post("/sign-out", status_code=204, responses=problem_responses(403, 404))
@needs("viewer", audited=True)
def sign_out(caller: KnownCaller, response: Response, service: ServiceParts) -> None:
    """End the session of the browser that asks."""
    if caller.session_id is not None:
        login_sessions.end_session(service.database, caller.account_id, caller.session_id)
    response.delete_cookie(service.access.cookie, path="/", httponly=True, samesite="strict")


def _check_local_token(service: Service, request: Request, token: str) -> None:
    if service.access.mode != "token":
        raise ApiError(409, "This server asks for an account and its password.", "token")
    # Nobody guesses it, so whoever has it need not wait for others who try.
    if not is_local_token(service.access, token):
        _admit(service, request, None)
        _tell(service, request, NOBODY, "enter", "refused", "wrong token")
        raise ApiError(403, "This is not the token of this server; 'sldr serve' prints it when it starts.", "token")


def _open_link(service: Service, request: Request, token: str) -> accounts.Account:
    try:
        return invitations.find_invited(service.database, token)
    except Refused as error:
        _admit(service, request, None)
        _tell(service, request, NOBODY, "open one-time link", "refused", str(error))
        raise


def _admit(service: Service, request: Request, name: str | None) -> None:
    """Count an attempt, and refuse whoever has failed too often."""
    pause_s = service.access.throttle.admit(name, client_address(request.scope))
    if pause_s:
        minutes = math.ceil(pause_s / 60)
        raise ApiError(429, f"Too many attempts have failed; try again in {minutes} min.")


def _start_session(service: Service, request: Request, response: Response, account_id: str | None, name: str) -> None:
    address, agent = client_address(request.scope), request.headers.get("user-agent", "")
    session, secret = login_sessions.start_session(service.database, account_id, address, agent)
    response.set_cookie(
        service.access.cookie,
        secret,
        expires=session.expires_at,
        path="/",
        secure=request.url.scheme == "https",
        httponly=True,
        samesite="strict",
    )
    _tell(service, request, name, "sign in", "done", agent)


def _tell(service: Service, request: Request, who: str, action: str, outcome: Outcome, detail: str) -> None:
    deed = Deed(who, action, client_address(request.scope), outcome, request.url.path, detail)
    record(service.database, deed)
