"""What stands on a cluster's node for one attempt: it starts the attempt's process, which ends with it."""

from __future__ import annotations

import os
import socket
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

from backend.store.claims import Claim
from backend.store.settings import load_settings
from worker.executors.cores import HeldCores
from worker.executors.local import CHILD_COMMAND, LocalChild, LocalExecutor
from worker.executors.ray_needs import Needs
from worker.executors.shared_home import is_same_home
from worker.machine import VISIBLE_VARIABLE


class NodeUnfit(Exception):
    """Report a node that cannot run attempts of this cluster: its text is one sentence."""


@dataclass(frozen=True)
class Placement:
    """Say where an attempt's process was started."""

    host: str
    """Name of the machine."""
    pid: int
    """Process id there."""


@dataclass(frozen=True)
class Terms:
    """Say under which terms nodes run attempts; the same for every attempt of a worker."""

    environment: Mapping[str, str]
    """Where store and files are, as environment variables."""
    only_host: str | None
    """The one machine on which attempts can run, if the store is a file there."""
    home_mark: str | None
    """What the data directory is known by, if every node has to see the very same one."""
    version: str
    """Of this product, at the worker."""
    command: Sequence[str] | None
    """What to start in place of a real training; tests do."""


class AttemptHost:
    """Hold the process of one attempt. All calls come one after the other, on the main thread of its own process."""

    def __init__(self) -> None:
        self._child: LocalChild | None = None
        self._cores: HeldCores | None = None

    def start(self, claim: Claim, terms: Terms, held: Needs) -> Placement:
        """Start the attempt.

        Args:
            held: what was set aside for it on this node.

        Raises:
            NodeUnfit: this node cannot run it.
            OSError: its process could not be started.
        """
        os.environ.update(terms.environment)
        settings = load_settings()
        check_node(terms, settings.home)
        if claim.config.compute.threads == 0:
            self._keep_to(held.cores)
        if not held.gpus:
            # Ray leaves the variable alone then, and the attempt would take a GPU that others count on.
            os.environ[VISIBLE_VARIABLE] = ""
        command = terms.command or CHILD_COMMAND
        self._child = LocalExecutor(settings, command, threads=held.cores).start(claim)
        return Placement(socket.gethostname(), self._child.pid)

    def tell(self, message: str) -> None:
        """Pass the attempt one line."""
        if self._child is not None:
            self._child.tell(message)

    def poll(self) -> int | None:
        """Return the process' exit status, or None while it runs."""
        assert self._child is not None
        return self._child.poll()

    def kill(self) -> None:
        """End the process and everything that it started, at once."""
        if self._child is not None:
            self._child.kill()

    def _keep_to(self, count: int) -> None:
        """Let the attempt see so many cores: it would take one thread for each core of the machine."""
        self._cores = HeldCores(os.sched_getaffinity(0), count)
        if len(self._cores.numbers) == count:
            os.sched_setaffinity(0, self._cores.numbers)


def check_node(terms: Terms, home: Path) -> None:
    """Make sure that attempts can run on this machine.

    Raises:
        NodeUnfit: they cannot.
    """
    host = socket.gethostname()
    if (here := version("sldr")) != terms.version:
        raise NodeUnfit(f"Node {host} has sldr {here} and its worker {terms.version}; install the same on both.")
    if terms.only_host not in (None, host):
        raise NodeUnfit(
            f"Node {host} cannot reach the store, which is a file on {terms.only_host}; "
            "a cluster of several machines needs PostgreSQL (SLDR_DATABASE_URL)."
        )
    if terms.home_mark is not None and not is_same_home(home, terms.home_mark):
        raise NodeUnfit(
            f"Node {host} does not see the data directory {home} of its worker; "
            "share it between all machines under one path, or name a place for files with SLDR_FILES_URL."
        )
