"""What strangers, and colleagues with too few rights, may try: each is refused, and stands in the audit log."""

from __future__ import annotations

import socket
from datetime import UTC, datetime, timedelta

import httpx
import pytest
from guarded_api import Guarded
from live_api import new_client
from signed_in import PATIENCE_S
from sqlalchemy import update
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect
from websockets.typing import Origin

from backend.api.app import LARGEST_BODY
from backend.api.tokens import TOKEN_LIFETIME, ViewerTokens
from backend.store.access.audit import list_entries
from backend.store.access.login_sessions import IDLE_LIFETIME
from backend.store.access.tables import login_sessions
from backend.store.claims import Claim
from backend.store.errors import StaleFence
from backend.store.files import register_file
from backend.store.launches import LaunchOrder, launch
from backend.store.queue import claim

LONG_HEAD = 64 * 2**20
"""More than a connection holds on its way, so that it was taken if all of it went [bytes]."""

EVIL = "http://evil.example"
SCRIPT = "<script>alert(1)</script>"
SQL = "x' OR '1'='1'; DROP TABLE runs; --"


@pytest.fixture(scope="module")
def held(api: Guarded) -> Claim:
    """Return a run that a worker holds, with one file."""
    launch(api.database, LaunchOrder("FetchPush", "manipulation", "her", (0,), "smoke"))
    held = claim(api.database, "here", lease_s=3600.0)
    assert held is not None
    path = api.settings.run_directory(held.run_id) / "policy-newest.pt"
    path.parent.mkdir(parents=True)
    path.write_bytes(b"policy")
    place = str(path.relative_to(api.settings.home))
    register_file(api.database, held, path.name, "policy", place, path.stat().st_size, "0" * 64)
    return held


@pytest.mark.parametrize(
    "path",
    [
        "/api/runs/{run}/files/../../../access-token",
        "/api/runs/{run}/files/..%2f..%2f..%2faccess-token",
        "/api/runs/{run}/files/%2e%2e%2f%2e%2e%2faccess-token",
        "/api/runs/..%2f..%2f/log",
        "/api/tasks/..%2f..%2faccess-token/picture",
        "/assets/..%2f..%2faccess-token",
        "/..%2faccess-token",
        "/viewer/..%2f..%2fapi/accounts",
    ],
)
def test_no_path_leaves_its_directory(api: Guarded, held: Claim, path: str):
    token = (api.settings.home / "access-token").read_text().strip()
    answer = api.programs["admin"].get(path.format(run=held.run_id))
    assert answer.status_code >= 400
    assert token not in answer.text
    if "%2f.." in path:
        assert ".." in (api.newest("refused").deed.target or "")


def test_a_file_can_be_had_by_its_own_name_only(api: Guarded, held: Claim):
    client = api.programs["viewer"]
    assert client.get(f"/api/runs/{held.run_id}/files/policy-newest.pt").content == b"policy"
    assert client.get(f"/api/runs/{held.run_id}/files/log.txt").status_code == 404


def test_a_forged_fence_writes_nothing(api: Guarded, held: Claim):
    forged = Claim(**{**vars(held), "fence": held.fence + 1})
    with pytest.raises(StaleFence):
        register_file(api.database, forged, "evil.pt", "policy", "evil.pt", 1, "0" * 64)
    assert api.programs["viewer"].get(f"/api/runs/{held.run_id}/files/evil.pt").status_code == 404


@pytest.mark.parametrize("secret", [b"another secret of thirty-two byte", b"x"])
def test_a_forged_token_of_a_3d_view_opens_nothing(api: Guarded, secret: bytes):
    forged = ViewerTokens(secret).sign("0" * 32, datetime.now(UTC))
    answer = api.programs["admin"].get(f"/viewer/{forged}/")
    assert answer.status_code == 403
    deed = api.newest("refused").deed
    assert (deed.who, deed.action, deed.target) == ("admin", "fetch view", "/viewer/***/")


def test_an_old_token_of_a_3d_view_opens_nothing(api: Guarded):
    old = api.app.state.service.tokens.sign("0" * 32, datetime.now(UTC) - TOKEN_LIFETIME - timedelta(seconds=1))
    assert api.programs["admin"].get(f"/viewer/{old}/").status_code == 403


@pytest.mark.parametrize("column", ["expires_at", "seen_at"])
def test_a_session_that_is_over_opens_nothing(api: Guarded, column: str):
    browser = api.sign_in("viewer")
    assert browser.get("/api/runs").status_code == 200
    past = datetime.now(UTC) - IDLE_LIFETIME - timedelta(seconds=1)
    with api.database.write() as conn:
        conn.execute(update(login_sessions).values({column: past}))
    answer = browser.get("/api/runs")
    assert answer.status_code == 401
    assert "ended" in answer.json()["problems"][0]["message"]
    assert (api.newest("refused").deed.who, api.newest("refused").deed.target) == ("nobody", "/api/runs")


def test_a_session_that_was_ended_elsewhere_opens_nothing(api: Guarded):
    browser, other = api.sign_in("viewer"), api.sign_in("viewer")
    [mine] = [session for session in other.get("/api/account/sessions").json()["sessions"] if session["is_this"]]
    for session in other.get("/api/account/sessions").json()["sessions"]:
        if session["id"] != mine["id"]:
            assert other.delete(f"/api/account/sessions/{session['id']}").status_code == 204
    assert browser.get("/api/runs").status_code == 401
    assert other.get("/api/runs").status_code == 200


def test_nobody_ends_the_session_of_another(api: Guarded):
    viewer, operator = api.sign_in("viewer"), api.sign_in("operator")
    [session] = [one for one in viewer.get("/api/account/sessions").json()["sessions"] if one["is_this"]]
    assert operator.delete(f"/api/account/sessions/{session['id']}").status_code == 404
    assert viewer.get("/api/runs").status_code == 200


@pytest.mark.parametrize("origin", [EVIL, "null", "http://127.0.0.1:1", "http://["])
def test_a_websocket_of_another_site_is_refused(api: Guarded, origin: str):
    browser = api.sign_in("viewer")
    cookie = "; ".join(f"{name}={value}" for name, value in browser.cookies.items())
    with pytest.raises(InvalidStatus, match="403"):
        connect(
            f"{api.address.replace('http', 'ws')}/viewer/x/",
            origin=Origin(origin),
            additional_headers={"Cookie": cookie},
            proxy=None,
        )
    assert api.newest("refused").deed.action == "websocket"


@pytest.mark.parametrize(
    "headers",
    [
        {"origin": EVIL},
        {"origin": "null"},
        {"origin": "http://["},
        {"origin": "http://127.0.0.1:1"},
        {"origin": "", "sec-fetch-site": "cross-site"},
        {"origin": "", "sec-fetch-site": "same-site"},
        {"origin": ""},
    ],
)
def test_another_site_changes_nothing_with_somebodys_cookie(api: Guarded, headers: dict[str, str]):
    browser = api.sign_in("operator")
    for name, value in headers.items():
        browser.headers[name] = value
    if not headers["origin"]:
        del browser.headers["origin"]
    answer = browser.post("/api/views", json={"name": "forged", "search": ""})
    assert answer.status_code == 403
    assert api.newest("refused").deed.target == "/api/views"
    assert api.programs["viewer"].get("/api/views").json() == {"views": []}


def test_another_site_reads_nothing_with_somebodys_cookie(api: Guarded):
    browser = api.sign_in("viewer")
    assert browser.get("/api/runs", headers={"sec-fetch-site": "cross-site"}).status_code == 403
    assert browser.get("/api/runs", headers={"sec-fetch-site": "same-site"}).status_code == 403
    assert browser.get("/api/runs", headers={"sec-fetch-site": "same-origin"}).status_code == 200


def test_a_form_of_another_site_is_no_json(api: Guarded):
    browser = api.sign_in("operator")
    content = {"content-type": "text/plain"}
    answer = browser.post("/api/views", content='{"name": "forged", "search": ""}', headers=content)
    assert answer.status_code == 422


@pytest.mark.parametrize("chunked", [False, True])
def test_a_body_that_is_too_large_is_not_taken(api: Guarded, chunked: bool):
    def pieces():
        for _ in range(LARGEST_BODY // 65536 + 1):
            yield b" " * 65536

    body = pieces() if chunked else b" " * (LARGEST_BODY + 1)
    answer = api.programs["operator"].post("/api/views", content=body, headers={"content-type": "application/json"})
    assert answer.status_code == 413
    assert "larger" in answer.json()["problems"][0]["message"]
    assert api.newest("refused").deed.detail == "POST, answered 413"


def test_a_head_without_an_end_is_cut_off(api: Guarded):
    url = httpx.URL(api.address)
    line = socket.create_connection((url.host, url.port), timeout=PATIENCE_S)
    with line, pytest.raises(ConnectionError):
        line.sendall(b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX: " + b"a" * LONG_HEAD)


def test_scripts_in_names_and_notes_stay_text(api: Guarded, held: Claim):
    client = api.programs["operator"]
    view = client.post("/api/views", json={"name": SCRIPT, "search": SCRIPT})
    assert client.put(f"/api/runs/{held.run_id}/notes", json={"notes": SCRIPT}).status_code == 204
    for answer in (view, client.get("/api/views"), client.get(f"/api/runs/{held.run_id}")):
        assert answer.headers["content-type"] == "application/json"
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert answer.headers["content-security-policy"].startswith("default-src 'none'")
    assert "script-src 'self' 'wasm-unsafe-eval'" in client.get("/").headers["content-security-policy"]
    client.delete(f"/api/views/{view.json()['id']}")


def test_a_script_in_an_address_is_not_played_back_as_one(api: Guarded):
    answer = api.programs["viewer"].get(f"/viewer/{SCRIPT}/", headers={"accept": "text/html"})
    assert "<script" not in answer.text


@pytest.mark.parametrize("field", ["task", "method", "preset", "state", "tag", "text", "study", "sort"])
def test_sql_in_filters_is_a_word_like_any_other(api: Guarded, held: Claim, field: str):
    answer = api.programs["viewer"].get("/api/runs", params={field: SQL})
    assert answer.status_code in (200, 422)
    if answer.status_code == 200 and field != "study":
        assert answer.json()["total"] in (0, 1)
    assert api.programs["viewer"].get(f"/api/runs/{held.run_id}").status_code == 200
    assert api.programs["admin"].get("/api/audit", params={"who": SQL}).json()["entries"] == []


def test_nobody_makes_a_token_that_may_do_more(api: Guarded):
    wish = {"name": "more", "role": "admin", "days": None}
    answer = api.sign_in("viewer").post("/api/account/tokens", json=wish)
    assert answer.status_code == 403
    assert api.newest("refused").deed.action == "create own token"


def test_the_token_of_loopback_opens_nothing_where_accounts_are_asked_for(api: Guarded):
    token = (api.settings.home / "access-token").read_text().strip()
    with new_client(api.address, token) as client:
        assert client.get("/api/runs").status_code == 401
    assert api.nobody.post("/api/auth/enter", json={"token": token}).status_code == 409


def test_no_secret_stands_in_the_audit_log(api: Guarded):
    api.sign_in("admin")
    written = str(list_entries(api.database, 500))
    assert "sldr_" not in written
    assert "otters" not in written
