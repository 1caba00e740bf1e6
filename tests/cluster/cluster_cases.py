"""A cluster to be hurt, attempts that only count, and waiting for what becomes of them."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import psutil

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.launches import LaunchOrder, launch
from backend.store.metrics import read_metrics
from backend.store.queue import claim
from worker.executors import Child, Executor

FAKE_CHILD = Path(__file__).parents[1] / "worker" / "fake_child.py"
PATIENCE_S = 60.0
"""Long, because the machine that runs the tests may be busy with others."""

Behave = Callable[[str], Executor]
"""Makes an executor whose children behave so."""


@dataclass
class Cluster:
    """Know the processes of a cluster."""

    home: Path
    """Where its token lies."""
    process: subprocess.Popen[str]
    """Keeps the nodes."""
    address: str
    """Its head, as host:port."""
    raylets: list[int]
    """The process of each node that has a core."""

    def kill_node_of(self, pid: int) -> None:
        """Kill the node on which a process runs, and all that belongs to it, as if its plug were pulled."""
        raylet = next(parent for parent in psutil.Process(pid).parents() if parent.pid in self.raylets)
        victims = [raylet, *raylet.children(recursive=True)]
        for victim in victims:
            with suppress(psutil.NoSuchProcess):
                victim.kill()


def fake_command(behaviour: str) -> list[str]:
    """Return the command of a child that behaves so."""
    return [sys.executable, str(FAKE_CHILD), behaviour]


def begin(db: Database, executor: Executor) -> tuple[Claim, Child]:
    """Queue and claim a run that needs no other, and start its attempt."""
    launch(db, LaunchOrder("FetchPush", "manipulation", "her", [0], "smoke"))
    claimed = claim(db, "worker-1")
    assert claimed is not None
    return claimed, executor.start(claimed)


def wait_until(is_so: Callable[[], bool], patience_s: float = PATIENCE_S) -> None:
    """Wait for something to come true."""
    deadline = time.monotonic() + patience_s
    while not is_so():
        assert time.monotonic() < deadline, "it did not come true in time"
        time.sleep(0.05)


def wait_for_end(child: Child) -> int:
    """Wait, without waiting for it, until a child has ended; return its exit status."""
    wait_until(lambda: child.poll() is not None)
    return child.wait()


def wait_for_cycles(db: Database, run_id: str, child: Child, cycles: int = 1) -> None:
    """Wait until an attempt has counted so far."""

    def counted() -> bool:
        assert child.poll() is None, f"it has ended: {child.outcome()}"
        return max(read_metrics(db, run_id).step, default=0) >= cycles

    wait_until(counted)


def is_running(pid: int) -> bool:
    """Tell whether a process is there and no zombie."""
    return psutil.pid_exists(pid) and psutil.Process(pid).status() != psutil.STATUS_ZOMBIE
