"""The product in real processes over one data directory, for browser tests and for scripts that look at the page."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Generator, Sequence
from contextlib import contextmanager
from pathlib import Path

import httpx
from signed_in import forget, know

STARTED_WITHIN_S = 60.0
"""The service answers by then, even on a busy machine [s]."""
ENDED_WITHIN_S = 40.0
"""The service ends all its children by then [s]."""

WHOLE = ("worker.cli", "serve")
"""Page, API, a worker and the viewer host."""
PAGE_AND_API = ("backend.api",)
"""Nothing that trains or draws."""


@contextmanager
def serving(
    home: Path, port: int, module: Sequence[str], needs: Sequence[str] = (), options: Sequence[str] = ()
) -> Generator[str]:
    """Serve a data directory and lend the address once it answers.

    Args:
        home: the data directory.
        port: a free port.
        module: what to run, `WHOLE` or `PAGE_AND_API`.
        needs: what must be alive, as `/healthz` names it.
        options: further words of the command line.

    Raises:
        RuntimeError: it did not come up.
    """
    address = f"http://127.0.0.1:{port}"
    log = home / "serve.log"
    with log.open("w") as output:
        command = [sys.executable, "-m", *module, "--port", str(port), *options]
        environment = {**os.environ, "SLDR_HOME": str(home)}
        process = subprocess.Popen(command, env=environment, stdout=output, stderr=subprocess.STDOUT)
    try:
        _wait_until_healthy(address, process, log, needs)
        if "--accounts" not in options:
            know(address, home)
        yield address
    finally:
        forget(address)
        process.send_signal(signal.SIGTERM)
        process.wait(timeout=ENDED_WITHIN_S)


def _wait_until_healthy(address: str, process: subprocess.Popen[bytes], log: Path, needs: Sequence[str]) -> None:
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
    raise RuntimeError(f"The service did not come up: {log.read_text()}")
