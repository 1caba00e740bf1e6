"""The whole product in real processes, and a real browser in front of it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Generator
from pathlib import Path

import httpx
import pytest

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
    command = [sys.executable, "-m", "worker.cli", "serve", "--port", str(port)]
    with (home / "serve.log").open("w") as output:
        environment = {**os.environ, "SLDR_HOME": str(home)}
        process = subprocess.Popen(command, env=environment, stdout=output, stderr=subprocess.STDOUT)
    try:
        _wait_until_healthy(address, process, home / "serve.log")
        yield address
    finally:
        process.send_signal(signal.SIGTERM)
        process.wait(timeout=ENDED_WITHIN_S)


def _wait_until_healthy(address: str, process: subprocess.Popen[bytes], output: Path) -> None:
    give_up_at = time.monotonic() + STARTED_WITHIN_S
    while time.monotonic() < give_up_at and process.poll() is None:
        try:
            health = httpx.get(f"{address}/healthz", timeout=2.0)
        except httpx.TransportError:
            time.sleep(0.2)
            continue
        if health.is_success and health.json()["workers_alive"] and health.json()["viewer_alive"]:
            return
        time.sleep(0.2)
    pytest.fail(f"sldr serve did not come up: {output.read_text()}")
