"""A whole service under attack: workers and APIs as processes of their own, started again when they die."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import psutil

from backend.store.settings import Settings

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
PAUSE_S = 0.2
"""Between the death of a process and its next start [s]."""
ENDING_S = 40.0
"""How long processes may take to end in good order; then they are killed [s]."""


@dataclass
class Kept:
    """Keep one process running; what it prints goes to a file."""

    command: list[str]
    environment: dict[str, str]
    log: Path
    starts: int = 0
    process: subprocess.Popen[bytes] | None = None
    start_at: float = 0.0

    def keep_alive(self) -> None:
        """Start it if it is not there and due."""
        if self.process is not None and self.process.poll() is not None:
            self.process, self.start_at = None, time.monotonic() + PAUSE_S
        if self.process is None and time.monotonic() >= self.start_at:
            with self.log.open("ab") as log:
                self.process = subprocess.Popen(self.command, env=self.environment, stdout=log, stderr=log, cwd=ROOT)
            self.starts += 1

    def end(self, until: float) -> None:
        """Let it end in good order until then, and kill it if it has not."""
        if self.process is None:
            return
        try:
            self.process.wait(max(0.1, until - time.monotonic()))
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()


@dataclass
class Service:
    """Hold the processes of a service."""

    settings: Settings
    workers: list[Kept] = field(default_factory=list)
    apis: list[Kept] = field(default_factory=list)
    addresses: list[str] = field(default_factory=list)

    def keep_alive(self) -> None:
        """Start what has died."""
        for kept in (*self.workers, *self.apis):
            kept.keep_alive()

    def living_workers(self) -> list[int]:
        """Return the process ids of the supervisors."""
        return [kept.process.pid for kept in self.workers if kept.process and kept.process.poll() is None]

    def living_apis(self) -> list[int]:
        """Return the process ids of the APIs."""
        return [kept.process.pid for kept in self.apis if kept.process and kept.process.poll() is None]

    def living_children(self) -> list[int]:
        """Return the process ids of what trains."""
        found: list[int] = []
        for pid in self.living_workers():
            try:
                found += [child.pid for child in psutil.Process(pid).children()]
            except psutil.NoSuchProcess:
                continue
        return found

    def logs(self) -> str:
        """Return all that its processes and those of its runs have printed."""
        files = [*(kept.log for kept in (*self.workers, *self.apis)), *self.settings.home.glob("runs/*/log.txt")]
        return "\n".join(path.read_text(errors="replace") for path in files if path.exists())


def make_service(
    settings: Settings, workers: int, apis: int, lease_s: float, child: Sequence[str], slots: int = 1
) -> Service:
    """Return a service whose processes wait to be started.

    Args:
        lease_s: how long a worker may be silent [s].
        child: the command of a child; the real one if empty.
    """
    environment = {**os.environ, **settings.as_environment(), "PYTHONPATH": str(ROOT)}
    service = Service(settings)
    worker = [sys.executable, str(HERE / "chaos_worker.py"), str(slots), str(lease_s), *child]
    for number in range(workers):
        service.workers.append(Kept(worker, environment, settings.home / f"worker-{number}.log"))
    for number in range(apis):
        port = _free_port()
        api = [sys.executable, "-m", "backend.api", "--port", str(port)]
        service.apis.append(Kept(api, environment, settings.home / f"api-{number}.log"))
        service.addresses.append(f"http://127.0.0.1:{port}")
    return service


@contextmanager
def running(service: Service) -> Generator[Service]:
    """Start a service, and end all of it when the block ends."""
    try:
        service.keep_alive()
        yield service
    finally:
        kept = [kept for kept in (*service.workers, *service.apis) if kept.process is not None]
        for one in kept:
            assert one.process is not None
            one.process.terminate()
        until = time.monotonic() + ENDING_S
        for one in kept:
            one.end(until)


def kill(pids: Sequence[int], choose: Callable[[Sequence[int]], int]) -> bool:
    """Kill one of several processes; tell whether there was one."""
    if not pids:
        return False
    try:
        os.kill(choose(pids), signal.SIGKILL)
    except ProcessLookupError:
        return False
    return True


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]
