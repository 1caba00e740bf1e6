"""Every address as nobody, viewer, operator and admin: who gets in is what the routes have declared."""

from __future__ import annotations

import re
from typing import Any

import httpx
import pytest
from fastapi import APIRouter, Depends
from fastapi.routing import APIRoute, APIWebSocketRoute
from guarded_api import Guarded
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect
from websockets.typing import Origin

from backend.api.access.declarations import Declaration, declaration_of, needs
from backend.api.access.gate import OPEN_PATHS, check_access
from backend.api.app import ROUTES
from backend.store import viewer_sessions
from backend.store.access.roles import ROLES, Role, allows
from backend.store.launches import LaunchOrder, launch

REFUSED = (401, 403)
DECLARED = {
    route.endpoint.__name__: declaration_of(route.endpoint)
    for module in ROUTES
    for route in module.router.routes
    if isinstance(route, APIRoute | APIWebSocketRoute)
}


def operations(api: Guarded) -> list[tuple[str, str, Declaration]]:
    """Return every operation of the schema: method, a path with ids that do not exist, who may call it."""
    found: list[tuple[str, str, Declaration]] = []
    for path, methods in api.app.openapi()["paths"].items():
        for method, operation in methods.items():
            declared = DECLARED[operation["operationId"]]
            assert declared is not None, operation["operationId"]
            found.append((method.upper(), re.sub(r"{\w+}", "0", path), declared))
    return found


def ask(client: httpx.Client, method: str, path: str) -> httpx.Response:
    """Send what a route cannot work with: whoever is let in learns that it is wrong, and nothing happens."""
    return client.request(method, path, json={"nonsense": True} if method in ("POST", "PUT", "PATCH") else None)


def test_every_route_says_who_may_call_it():
    assert [name for name, declared in DECLARED.items() if declared is None] == []


def test_what_is_open_to_all_is_what_the_gate_lets_through():
    open_names = {name for name, declared in DECLARED.items() if declared and declared.role is None}
    paths = {
        route.path
        for module in ROUTES
        for route in module.router.routes
        if isinstance(route, APIRoute) and route.endpoint.__name__ in open_names
    }
    assert paths == OPEN_PATHS | {"/healthz"}


def test_nobody_gets_beyond_the_gate(api: Guarded):
    let_in = [
        (method, path)
        for method, path, declared in operations(api)
        if declared.role is not None and ask(api.nobody, method, path).status_code != 401
    ]
    assert let_in == []


@pytest.mark.parametrize("role", ROLES)
def test_each_role_reaches_what_it_may_and_nothing_else(api: Guarded, role: Role):
    wrong: list[Any] = []
    for method, path, declared in operations(api):
        answer = ask(api.programs[role], method, path)
        may = declared.role is None or allows(role, declared.role)
        if (answer.status_code not in REFUSED) != may or answer.status_code >= 500:
            wrong.append((method, path, answer.status_code, answer.text))
    assert wrong == []


@pytest.mark.parametrize("path", ["/api/openapi.json", "/api", "/api/nope", "/viewer/x/", "/viewer/x/y.js"])
def test_what_is_in_no_schema_is_closed_to_nobody_too(api: Guarded, path: str):
    assert api.nobody.get(path).status_code == 401
    assert api.programs["viewer"].get(path).status_code != 401


@pytest.mark.parametrize("path", ["/", "/sign-in", "/runs/abc", "/assets/app-1.js"])
def test_the_page_itself_comes_to_everybody(api: Guarded, path: str):
    assert api.nobody.get(path, headers={"accept": "text/html,*/*"}).status_code == 200


def test_health_is_told_to_everybody(api: Guarded):
    assert api.nobody.get("/healthz").status_code == 200


@pytest.fixture(scope="module")
def view_path(api: Guarded) -> str:
    """Return the address of a 3D view that is ready, behind which nobody listens any more."""
    [run_id] = launch(api.database, LaunchOrder("FetchPush", "manipulation", "her", (0,), "smoke"))
    session = viewer_sessions.request_session(api.database, run_id)
    viewer_sessions.mark_ready(api.database, session.id, 1, control_port=1)
    token = api.app.state.service.tokens.sign(session.id, session.created_at)
    return f"/viewer/{token}"


@pytest.mark.parametrize("role", ROLES)
def test_a_3d_view_opens_for_each_role(api: Guarded, view_path: str, role: Role):
    assert api.programs[role].get(f"{view_path}/").status_code == 502
    for end in ("", "/", "/control"):
        assert dial(api, view_path + end, api.programs[role].headers["authorization"]) == 502


def test_a_3d_view_stays_closed_to_nobody_whatever_its_address(api: Guarded, view_path: str):
    assert api.nobody.get(f"{view_path}/").status_code == 401
    for end in ("", "/", "/control"):
        assert dial(api, view_path + end, None) == 401


def test_a_route_that_declares_nothing_answers_nobody(api: Guarded):
    router = APIRouter()

    @router.get("/api/forgotten")
    def forgotten() -> str:
        return "secret"

    @router.get("/api/declared")
    @needs("viewer")
    def declared() -> str:
        return "shown"

    api.app.include_router(router, dependencies=[Depends(check_access)])
    routes = api.app.router.routes
    routes.insert(0, routes.pop())
    try:
        assert api.programs["admin"].get("/api/forgotten").status_code == 403
        assert api.programs["viewer"].get("/api/declared").json() == "shown"
    finally:
        routes.pop(0)


def dial(api: Guarded, path: str, authorization: str | None) -> int:
    """Return the status with which a websocket is refused."""
    headers = {} if authorization is None else {"Authorization": authorization}
    address = api.address.replace("http", "ws") + path
    with pytest.raises(InvalidStatus) as refused:
        connect(address, origin=Origin(api.address), additional_headers=headers, proxy=None)
    return refused.value.response.status_code


def test_whatever_takes_a_body_says_that_it_may_not_be_readable(api: Guarded):
    operations = [one for methods in api.app.openapi()["paths"].values() for one in methods.values()]
    taking = [one for one in operations if "requestBody" in one]
    assert taking
    assert [one["operationId"] for one in taking if "400" not in one["responses"]] == []
