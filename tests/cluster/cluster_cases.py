"""A cluster to be hurt, attempts that only count, and waiting for what becomes of them."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import psutil
from other_processes import PATIENCE_S, is_running, wait_until

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.launches import LaunchOrder, launch
from backend.store.metrics import read_metrics
from backend.store.queue import claim
from backend.store.settings import Settings
from worker.executors import Child, Executor

Behave = Callable[[str], Executor]
"""Makes an executor whose children behave so."""


class ClusterNotStarted(Exception):
    """Report what a cluster said that ended before it began."""


class Cluster:
    """Know the processes of a cluster."""

    def __init__(self, home: Path, process: subprocess.Popen[str]) -> None:
        """Take a `two_nodes.py` that has just been started.

        Args:
            home: where its token lies.
        """
        self.home = home
        self._process = process
        self.address, self._raylets = self._read()

    def complete(self) -> None:
        """Replace the nodes that have been killed."""
        if not all(is_running(raylet) for raylet in self._raylets):
            assert self._process.stdin is not None
            self._process.stdin.write("complete\n")
            self._process.stdin.flush()
            _, self._raylets = self._read()

    def node_of(self, pid: int) -> psutil.Process:
        """Return the Ray process of the node on which a process runs."""
        return next(parent for parent in psutil.Process(pid).parents() if parent.pid in self._raylets)

    def kill_node_of(self, pid: int) -> None:
        """Kill the node on which a process runs, and all that belongs to it, as if its plug were pulled."""
        raylet = self.node_of(pid)
        for victim in [raylet, *raylet.children(recursive=True)]:
            with suppress(psutil.NoSuchProcess):
                victim.kill()

    def end(self) -> None:
        """Take it down in good order."""
        self._process.communicate(timeout=PATIENCE_S)

    def _read(self) -> tuple[str, list[int]]:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            raise ClusterNotStarted((self.home / "cluster.log").read_text())
        said = json.loads(line)
        return said["address"], said["raylets"]


def queue_run(db: Database, overrides: Mapping[str, Any] | None = None) -> str:
    """Queue a run that needs no other."""
    return launch(db, LaunchOrder("FetchPush", "manipulation", "her", [0], "smoke", overrides or {}))[0]


def begin(db: Database, executor: Executor, overrides: Mapping[str, Any] | None = None) -> tuple[Claim, Child]:
    """Queue and claim a run, and start its attempt."""
    queue_run(db, overrides)
    claimed = claim(db, "worker-1")
    assert claimed is not None
    return claimed, executor.start(claimed)


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


def process_of(settings: Settings, run_id: str) -> int:
    """Return the process that said last in the run's log that it begins."""
    log = (settings.run_directory(run_id) / "log.txt").read_text()
    begun = [line for line in log.splitlines() if "begins in process" in line]
    return int(begun[-1].rstrip(".").split()[-1])
