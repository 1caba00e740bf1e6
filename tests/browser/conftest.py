"""The whole product in real processes, and a real browser in front of it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path

import httpx
import pytest
from plausible_runs import launch_matrix, play_out

from backend.store.database import open_database
from backend.store.settings import Settings, sqlite_url

STARTED_WITHIN_S = 60.0
"""`sldr serve` answers by then, even on a busy machine [s]."""
ENDED_WITHIN_S = 40.0
"""`sldr serve` ends all its children by then [s]."""


@pytest.fixture(scope="session")
def product(tmp_path_factory: pytest.TempPathFactory, find_free_port: Callable[[], int]) -> Generator[str]:
    """Serve page, API, a worker and the viewer host with an empty data directory; return the address."""
    home = tmp_path_factory.mktemp("home")
    port = find_free_port()
    address = f"http://127.0.0.1:{port}"
    with _running(["worker.cli", "serve"], home, port) as process:
        _wait_until_healthy(address, process, home, needs=("workers_alive", "viewer_alive"))
        yield address


@pytest.fixture(scope="session")
def filled_product(tmp_path_factory: pytest.TempPathFactory, find_free_port: Callable[[], int]) -> Generator[str]:
    """Serve page and API over runs that have ended, run and wait; nothing is trained. Return the address."""
    home = tmp_path_factory.mktemp("filled")
    database = open_database(Settings(home=home, database_url=sqlite_url(home)))
    launch_matrix(database, ("FetchPush", "FetchSlide"), ("her", "her-sldr"), range(3))
    play_out(database, epochs=20, share_of=lambda claim: 0.6 if claim.config.seed == 2 else 1.0)
    launch_matrix(database, ("FetchPush",), ("ddpg",), range(2))
    database.close()
    port = find_free_port()
    address = f"http://127.0.0.1:{port}"
    with _running(["backend.api"], home, port) as process:
        _wait_until_healthy(address, process, home, needs=())
        yield address


@contextmanager
def _running(module: list[str], home: Path, port: int) -> Generator[subprocess.Popen[bytes]]:
    command = [sys.executable, "-m", *module, "--port", str(port)]
    with (home / "serve.log").open("w") as output:
        environment = {**os.environ, "SLDR_HOME": str(home)}
        process = subprocess.Popen(command, env=environment, stdout=output, stderr=subprocess.STDOUT)
    try:
        yield process
    finally:
        process.send_signal(signal.SIGTERM)
        process.wait(timeout=ENDED_WITHIN_S)


def _wait_until_healthy(address: str, process: subprocess.Popen[bytes], home: Path, needs: tuple[str, ...]) -> None:
    give_up_at = time.monotonic() + STARTED_WITHIN_S
    while time.monotonic() < give_up_at and process.poll() is None:
        try:
            health = httpx.get(f"{address}/healthz", timeout=2.0)
        except httpx.TransportError:
            time.sleep(0.2)
            continue
        if health.is_success and all(health.json()[name] for name in needs):
            return
        time.sleep(0.2)
    pytest.fail(f"The service did not come up: {(home / 'serve.log').read_text()}")
