"""An API that really listens, and the store below it, to put there what workers would."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import httpx
from fastapi import FastAPI
from signed_in import PATIENCE_S

from backend.api.__main__ import make_server
from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.files import register_file
from backend.store.launches import LaunchOrder, launch
from backend.store.queue import claim
from backend.store.settings import Settings
from backend.store.workers import register_worker


@dataclass(frozen=True)
class Service:
    """The API and what lies below it."""

    client: httpx.Client
    settings: Settings
    database: Database

    def get(self, path: str, **options: Any) -> Any:
        """Return the JSON of an answer that has to be good."""
        answer = self.client.get(path, **options)
        assert answer.status_code == 200, answer.text
        return answer.json()

    def launch(self, method: str = "her", seeds: tuple[int, ...] = (0,), task: str = "FetchPush") -> list[str]:
        """Launch runs past the API."""
        return launch(self.database, LaunchOrder(task, "manipulation", method, seeds, "smoke"))

    def claim(self) -> Claim:
        """Take the oldest queued run, as a worker does."""
        taken = claim(self.database, register_worker(self.database, "here", 1, 1))
        assert taken is not None
        return taken

    def write_file(self, held: Claim, name: str, content: bytes) -> None:
        """Store a file of a run, as a worker does."""
        path = self.settings.run_directory(held.run_id) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
        relative = str(path.relative_to(self.settings.home))
        register_file(self.database, held, name, "policy", relative, len(content), "0" * 64)


@contextmanager
def serving(app: FastAPI) -> Iterator[str]:
    """Serve an application on a free port, in a thread, and hand out its address."""
    server = make_server(app, "127.0.0.1", 0)
    thread = threading.Thread(target=server.run)
    thread.start()
    try:
        while not server.started:
            assert thread.is_alive()
            time.sleep(0.005)
        port = server.servers[0].sockets[0].getsockname()[1]
        yield f"http://127.0.0.1:{port}"
    finally:
        server.should_exit = True
        thread.join()


def new_client(address: str, token: str | None = None) -> httpx.Client:
    """Return a client of a server on this machine, with its token, or as nobody."""
    headers = None if token is None else bearer(token)
    return httpx.Client(base_url=address, trust_env=False, verify=False, timeout=PATIENCE_S, headers=headers)


def bearer(token: str) -> dict[str, str]:
    """Return the header that shows a token."""
    return {"Authorization": f"Bearer {token}"}


@contextmanager
def serving_client(app: FastAPI) -> Iterator[httpx.Client]:
    """Serve an application and hand out a client that may do everything."""
    with serving(app) as address, new_client(address, app.state.service.access.local_token) as client:
        yield client


def problem_fields(answer: Any) -> list[str | None]:
    """Return the fields that an error answer names, after a look at its form."""
    problems = answer.json()["problems"]
    assert all(set(problem) == {"field", "message"} and problem["message"] for problem in problems)
    return [problem["field"] for problem in problems]
