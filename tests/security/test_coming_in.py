"""Coming in: by the printed address, with a password, with a one-time link; and what is promised about secrets."""

from __future__ import annotations

import json
import logging
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal

import httpx
import pytest
from argon2 import PasswordHasher, extract_parameters
from guarded_api import CHEAP, PASSWORD, Guarded
from live_api import new_client, serving
from starlette.requests import HTTPConnection

from backend.api.access.callers import Caller
from backend.api.access.passwords import LANES, MEMORY_KIB, TIME_COST, Passwords, find_weakness
from backend.api.access.recent_callers import KNOWN_FOR_S, RecentCallers
from backend.api.app import create_app
from backend.logs import HumanLines, JsonLines
from backend.redaction import redact
from backend.store.access.entry import choose_mode, greet
from backend.store.access.local_token import load_local_token
from backend.store.settings import Settings, sqlite_url


@pytest.fixture(scope="module")
def local(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, Settings]]:
    """Return the address of an API on loopback, and its data directory."""
    home = tmp_path_factory.mktemp("local")
    settings = Settings(home=home, database_url=sqlite_url(home))
    with serving(create_app(settings, home / "dist", passwords=CHEAP)) as address:
        yield address, settings


def test_the_printed_address_opens_once_clicked_and_leaves_no_token_behind(local: tuple[str, Settings]):
    address, settings = local
    printed = greet(settings, address, "token").split()[-1]
    with new_client(address) as browser:
        assert browser.get("/api/runs").status_code == 401
        answer = browser.get(printed, follow_redirects=True)
        assert str(answer.url) == f"{address}/"
        assert browser.get("/api/runs").status_code == 200
        browser.get(printed, follow_redirects=True)
        assert len(browser.get("/api/account/sessions").json()["sessions"]) == 1
        [cookie] = [step.headers["set-cookie"] for step in answer.history if "set-cookie" in step.headers]
    assert {"HttpOnly", "Path=/", "SameSite=strict"} <= {part.strip() for part in cookie.split(";")}
    assert load_local_token(settings) not in cookie


def test_a_wrong_token_leads_to_the_page_that_says_so(local: tuple[str, Settings]):
    address, _ = local
    with new_client(address) as browser:
        answer = browser.get("/?token=sldr_wrong")
        assert answer.headers["location"] == "/api/auth/enter?token=sldr_wrong"
        assert browser.get(answer.headers["location"]).headers["location"] == "/sign-in?reason=token"
        assert browser.get("/api/auth/me").json()["caller"] is None


def test_the_token_is_for_its_owner_and_stays(local: tuple[str, Settings]):
    _, settings = local
    path = settings.access_token_path
    assert path.stat().st_mode & 0o777 == 0o600
    assert load_local_token(settings) == load_local_token(settings)
    path.chmod(0o644)
    load_local_token(settings)
    assert path.stat().st_mode & 0o777 == 0o600


@pytest.mark.parametrize(
    ("host", "accounts", "mode"),
    [
        ("127.0.0.1", False, "token"),
        ("localhost", False, "token"),
        ("::1", False, "token"),
        ("127.0.0.1", True, "accounts"),
        ("0.0.0.0", False, "accounts"),
        ("::", False, "accounts"),
        ("", False, "accounts"),
        ("10.0.0.7", False, "accounts"),
    ],
)
def test_beyond_this_machine_accounts_are_asked_for(host: str, accounts: bool, mode: str):
    assert choose_mode(host, accounts) == mode


def test_the_first_admin_comes_in_with_the_printed_link(tmp_path: Path):
    settings = Settings(home=tmp_path, database_url=sqlite_url(tmp_path))
    with serving(create_app(settings, tmp_path / "dist", mode="accounts", passwords=CHEAP)) as address:
        greeting = greet(settings, address, "accounts")
        token = greeting.partition("/welcome#")[2].strip()
        with new_client(address) as browser:
            browser.headers["origin"] = address
            assert browser.post("/api/auth/invitation", json={"token": token}).json()["role"] == "admin"
            short = browser.post("/api/auth/invitation/accept", json={"token": token, "password": "short"})
            assert short.status_code == 422
            wish = {"token": token, "password": PASSWORD}
            assert browser.post("/api/auth/invitation/accept", json=wish).status_code == 204
            assert browser.get("/api/accounts").status_code == 200
            assert browser.post("/api/auth/invitation/accept", json=wish).status_code == 409
        assert "/welcome#" not in greet(settings, address, "accounts")


def test_a_new_password_is_asked_for_with_the_old_one_and_ends_other_sessions(api: Guarded):
    browser, other = api.sign_in("operator"), api.sign_in("operator")
    wrong = browser.put("/api/account/password", json={"old": "x", "new": "nine green herons"})
    assert wrong.status_code == 403
    wish = {"old": PASSWORD, "new": "nine green herons"}
    assert browser.put("/api/account/password", json=wish).status_code == 204
    assert (browser.get("/api/runs").status_code, other.get("/api/runs").status_code) == (200, 401)
    api.sign_in("operator", "nine green herons")


def test_signing_out_ends_the_session_and_not_only_the_cookie(api: Guarded):
    browser = api.sign_in("viewer")
    [(name, secret)] = browser.cookies.items()
    assert browser.post("/api/auth/sign-out").status_code == 204
    assert browser.get("/api/runs", headers={"cookie": f"{name}={secret}"}).status_code == 401


def test_a_role_that_is_taken_away_is_gone_at_once(api: Guarded):
    admin = api.programs["admin"]
    made = admin.post("/api/accounts", json={"name": "eve", "role": "operator"}).json()
    token = made["path"].partition("#")[2]
    browser = api.browser()
    assert browser.post("/api/auth/invitation/accept", json={"token": token, "password": PASSWORD}).status_code == 204
    wish = {"name": "hers", "search": ""}
    assert browser.post("/api/views", json=wish).status_code == 201
    admin.patch(f"/api/accounts/{made['account']['id']}", json={"role": "viewer"})
    assert browser.post("/api/views", json=wish).status_code == 403
    admin.patch(f"/api/accounts/{made['account']['id']}", json={"disabled": True})
    assert browser.get("/api/runs").status_code == 401


def test_a_token_may_do_what_its_role_says(api: Guarded):
    browser = api.sign_in("admin")
    made = browser.post("/api/account/tokens", json={"name": "notebook", "role": "viewer", "days": 1}).json()
    with new_client(api.address, made["secret"]) as program:
        assert program.get("/api/runs").status_code == 200
        assert program.post("/api/views", json={"name": "x", "search": ""}).status_code == 403
        browser.delete(f"/api/account/tokens/{made['token']['id']}")
        assert program.get("/api/runs").status_code == 401


def token_of(client: httpx.Client, role: str, days: int) -> tuple[dict[str, Any], str]:
    made = client.post("/api/account/tokens", json={"name": "made", "role": role, "days": days}).json()
    return made["token"], made["secret"]


def test_a_token_makes_no_token_that_would_outlive_it(api: Guarded):
    _, secret = token_of(api.sign_in("admin"), "admin", 1)
    with new_client(api.address, secret) as program:
        answer = program.post("/api/account/tokens", json={"name": "made", "role": "viewer", "days": 1})
    assert (answer.status_code, answer.json()["problems"][0]["message"][:22]) == (403, "A token makes no token")
    assert api.newest("refused").deed.action == "create own token"


def test_a_program_that_may_do_less_than_its_owner_takes_nothing_away_from_them(api: Guarded):
    browser = api.sign_in("admin")
    strong, _ = token_of(browser, "admin", 1)
    weak, secret = token_of(browser, "operator", 1)
    [session, *_] = browser.get("/api/account/sessions").json()["sessions"]
    with new_client(api.address, secret) as program:
        for address in (f"tokens/{strong['id']}", f"sessions/{session['id']}"):
            assert program.delete(f"/api/account/{address}").status_code == 403
        assert program.delete(f"/api/account/tokens/{weak['id']}").status_code == 204
    assert browser.get("/api/runs").status_code == 200
    assert browser.delete(f"/api/account/tokens/{strong['id']}").status_code == 204


def test_what_was_changed_stands_in_the_log_with_who_did_it(api: Guarded):
    api.programs["operator"].post("/api/views", json={"name": "seen", "search": ""})
    deed = api.newest("done").deed
    assert (deed.who, deed.action, deed.target, deed.address) == ("operator", "save view", "/api/views", "127.0.0.1")


def test_passwords_are_kept_as_argon2id_with_the_parameters_that_are_promised():
    passwords = Passwords()
    stored = passwords.hash(PASSWORD)
    assert stored.startswith(f"$argon2id$v=19$m={MEMORY_KIB},t={TIME_COST},p={LANES}$")
    assert MEMORY_KIB >= 19 * 1024
    assert passwords.matches(stored, PASSWORD)
    assert not passwords.matches(stored, PASSWORD + " ")
    assert not passwords.matches(None, "the password of an account that does not exist")
    assert not passwords.matches("no hash", PASSWORD)
    assert (passwords.is_outdated(stored), passwords.is_outdated(CHEAP.hash("x"))) == (False, True)


def test_an_account_that_does_not_exist_takes_as_long_to_refuse():
    compared: list[str] = []

    class Watched(PasswordHasher):
        def verify(self, hash: str | bytes, password: str | bytes) -> Literal[True]:
            compared.append(str(hash))
            return super().verify(hash, password)

    passwords = Passwords(Watched(time_cost=1, memory_cost=8, parallelism=1))
    stored = passwords.hash(PASSWORD)
    assert not passwords.matches(stored, "another")
    assert not passwords.matches(None, "another")
    ours, nobodys = compared
    assert extract_parameters(nobodys) == extract_parameters(ours)
    assert nobodys != stored


@pytest.mark.parametrize("password", ["short", "a" * 300, "aaaaaaaaaaaaaaaa", "adaadaadaada", "ada123456789!"])
def test_weak_passwords_are_told_why(password: str):
    assert find_weakness("ada", password)


@pytest.mark.parametrize("password", [PASSWORD, "correct horse battery staple", "häßliche Entlein 🦆"])
def test_good_passwords_are_taken(password: str):
    assert find_weakness("ada", password) is None


@pytest.mark.parametrize(
    ("said", "shown"),
    [
        ("GET /?token=sldr_abc HTTP/1.1", "GET /?token=*** HTTP/1.1"),
        ("GET /viewer/eyJhIjoxfQ.sig/control", "GET /viewer/***/control"),
        ("Authorization: Bearer abc.def", "Authorization: Bearer ***"),
        ("postgresql://sldr:pass@db/sldr", "postgresql://***@db/sldr"),
        ("key sldr_0123456789abcdefghijABCDEFGHIJ-_", "key ***"),
        ("GET /api/runs?task=FetchPush", "GET /api/runs?task=FetchPush"),
    ],
)
def test_secrets_are_taken_out_of_what_is_logged(said: str, shown: str):
    assert redact(said) == shown
    record = logging.LogRecord("uvicorn.access", logging.INFO, "", 0, "%s", (said,), None)
    assert HumanLines().format(record).endswith(shown)
    assert json.loads(JsonLines("api").format(record))["message"] == shown


def test_a_page_that_takes_older_answers_is_signed_out_at_once_all_the_same(api: Guarded):
    browser, patient = api.sign_in("viewer"), {"cache-control": "max-age=5"}
    assert browser.get("/api/runs", headers=patient).status_code == 200
    secret = dict(browser.cookies)
    assert browser.post("/api/auth/sign-out").status_code == 204
    browser.cookies.update(secret)
    assert browser.get("/api/runs", headers=patient).status_code == 401


def test_somebody_is_known_for_a_second_and_never_longer():
    now = 0.0
    recent = RecentCallers(lambda: now)
    asked = HTTPConnection({"type": "http", "headers": [(b"cookie", b"sldr=a")]})
    other = HTTPConnection({"type": "http", "headers": [(b"cookie", b"sldr=b")]})
    ada = Caller("ada", "viewer", "1", "2")
    recent.remember(asked, ada, recent.now(), writes=3)
    assert recent.find(asked, 5.0, writes=3) is ada
    assert recent.find(other, 5.0, writes=3) is None
    assert recent.find(asked, 0.0, writes=3) is None, "it asked for what is new"
    assert recent.find(asked, 5.0, writes=4) is None, "she may have been signed out"
    now = KNOWN_FOR_S + 0.01
    assert recent.find(asked, 5.0, writes=3) is None
