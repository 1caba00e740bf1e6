"""An API that asks for accounts, with somebody of each role, and a look at what it wrote down."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from unittest.mock import patch

import httpx
from argon2 import PasswordHasher
from fastapi import FastAPI
from live_api import new_client, serving

from backend.api.access.passwords import Passwords
from backend.api.app import create_app
from backend.store.access import accounts, api_tokens
from backend.store.access.audit import AuditEntry, list_entries
from backend.store.access.roles import ROLES, Role
from backend.store.database import Database
from backend.store.settings import Settings, sqlite_url

PASSWORD = "seven purple otters"
CHEAP = Passwords(PasswordHasher(time_cost=1, memory_cost=8, parallelism=1))
"""Passwords that take no time; how they are kept is tested by itself."""


@dataclass(frozen=True)
class Guarded:
    """An API in front of accounts, and one program of each role."""

    app: FastAPI
    address: str
    nobody: httpx.Client
    programs: dict[Role, httpx.Client]
    database: Database
    settings: Settings
    open_clients: ExitStack

    def browser(self) -> httpx.Client:
        """Return a client that keeps cookies and sends what a browser's page would."""
        client = self.open_clients.enter_context(new_client(self.address))
        client.headers["origin"] = self.address
        return client

    def sign_in(self, name: str, password: str = PASSWORD) -> httpx.Client:
        """Return a browser that is signed in."""
        client = self.browser()
        answer = client.post("/api/auth/sign-in", json={"name": name, "password": password})
        assert answer.status_code == 204, answer.text
        return client

    def newest(self, outcome: str | None = None) -> AuditEntry:
        """Return what was written down last."""
        [entry] = list_entries(self.database, 1, outcome=outcome)  # type: ignore[arg-type]
        return entry


def _draw_nothing(drawings: Sequence[object]) -> list[bytes]:
    """Stand in for drawing, which takes seconds and has tests of its own."""
    return [b"drawn"] * len(drawings)


@contextmanager
def guarded(home: Path) -> Generator[Guarded]:
    """Serve an empty data directory to accounts named like their roles, all with `PASSWORD`."""
    page = home / "dist"
    (page / "assets").mkdir(parents=True)
    (page / "index.html").write_text("<title>SLDR</title>")
    (page / "assets" / "app-1.js").write_text("1;")
    settings = Settings(home=home, database_url=sqlite_url(home))
    app = create_app(settings, page, mode="accounts", passwords=CHEAP)
    with ExitStack() as stack:
        for module in ("backend.api.routes.compare_exports", "backend.figures.bundle"):
            stack.enter_context(patch(f"{module}.draw_apart", _draw_nothing))
        address = stack.enter_context(serving(app))
        database = app.state.service.database
        programs: dict[Role, httpx.Client] = {}
        for role in ROLES:
            account = accounts.create_account(database, role, role)
            accounts.set_password(database, account.id, CHEAP.hash(PASSWORD))
            _, secret = api_tokens.create_token(database, account.id, "tests", role, None)
            programs[role] = stack.enter_context(new_client(address, secret))
        nobody = stack.enter_context(new_client(address))
        yield Guarded(app, address, nobody, programs, database, settings, stack)
