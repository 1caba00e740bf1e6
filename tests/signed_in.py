"""Programs and browsers that a served data directory knows: the one place where tests get its token from."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import httpx

from backend.store.access.local_token import load_local_token
from backend.store.settings import Settings, sqlite_url

PATIENCE_S = 60.0
"""An answer is there by then, even on a busy machine [s]."""

_tokens: dict[str, str] = {}
"""The token of each server that runs, by its address."""


def know(address: str, home: Path) -> None:
    """Remember the token of a server that runs."""
    _tokens[address] = load_local_token(Settings(home=home, database_url=sqlite_url(home)))


def forget(address: str) -> None:
    """Forget a server that has ended."""
    _tokens.pop(address, None)


def bearer(token: str) -> dict[str, str]:
    """Return the header with which a program shows a token."""
    return {"Authorization": f"Bearer {token}"}


def credentials(address: str) -> dict[str, str]:
    """Return the header with which a program shows the token of a server that runs."""
    return bearer(_tokens[address])


def program(address: str) -> httpx.Client:
    """Return a client that a server knows."""
    return httpx.Client(base_url=address, headers=credentials(address), trust_env=False, timeout=PATIENCE_S)


def get(address: str, path: str) -> Any:
    """Return the JSON of an answer that has to be good."""
    with program(address) as client:
        return client.get(path).raise_for_status().json()


def cookies() -> list[dict[str, Any]]:
    """Return what a browser holds that is signed in to every server that runs."""
    held: list[dict[str, Any]] = []
    for address, token in _tokens.items():
        answer = httpx.post(f"{address}/api/auth/enter", json={"token": token}, trust_env=False, timeout=PATIENCE_S)
        answer.raise_for_status()
        held += [{"name": name, "value": value, "url": address} for name, value in answer.cookies.items()]
    return held
