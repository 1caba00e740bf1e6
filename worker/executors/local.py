"""Running attempts on this machine: one child process each, in a process group of its own."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Sequence
from contextlib import suppress

from backend.store.claims import Claim, claim_to_json
from backend.store.files import LOG_FILE
from backend.store.outcomes import Outcome
from backend.store.settings import Settings
from sldr_core.processor import THREADS_VARIABLE
from worker.executors.endings import failure_of
from worker.machine import VISIBLE_VARIABLE, Gpu

CHILD_COMMAND = (sys.executable, "-m", "worker.child")


class LocalChild:
    """Hold the process of one attempt."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    @property
    def pid(self) -> int:
        """Its process id, which is also that of its group."""
        return self._process.pid

    @property
    def place(self) -> str:
        """Its process, in words."""
        return f"process {self.pid}"

    def tell(self, message: str) -> None:
        """Pass it one line; one that no longer listens is left alone."""
        assert self._process.stdin is not None
        with suppress(BrokenPipeError):
            self._process.stdin.write(message + "\n")
            self._process.stdin.flush()

    def poll(self) -> int | None:
        """Return its exit status (a negative signal number if it was killed), or None while it runs."""
        return self._process.poll()

    def outcome(self) -> Outcome:
        """Say how the attempt ended, as far as its exit status tells."""
        return failure_of(self._process.wait())

    def kill(self) -> None:
        """End it and everything that it started, at once."""
        if self._process.poll() is None:
            with suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGKILL)

    def wait(self) -> int:
        """Wait until it has ended and let go of it."""
        status = self._process.wait()
        assert self._process.stdin is not None
        with suppress(BrokenPipeError):
            self._process.stdin.close()
        return status


class LocalExecutor:
    """Start attempts as child processes.

    Start them from the main thread only: a child ends with the thread that started it.
    """

    def __init__(
        self,
        settings: Settings,
        command: Sequence[str] = CHILD_COMMAND,
        gpus: Sequence[Gpu] = (),
        threads: int | None = None,
    ) -> None:
        """Prepare for attempts.

        Args:
            command: what to start; tests have their own.
            gpus: where there are several, each attempt sees the one that the fewest others see.
            threads: what an attempt takes that names no number itself; as many as it sees cores if None.
        """
        self._settings = settings
        self._command = list(command)
        self._gpus = [gpu.device for gpu in gpus]
        self._share = {} if threads is None else {THREADS_VARIABLE: str(threads)}
        self._given: list[tuple[str, LocalChild]] = []

    def has_room(self) -> bool:
        """Tell that another process can always be started; the supervisor's slots are the limit."""
        return True

    def has_gpu(self) -> bool:
        """Tell whether this machine had a GPU when the worker started."""
        return bool(self._gpus)

    def start(self, claim: Claim) -> LocalChild:
        """Start an attempt; what its process prints goes to the log in the run's directory."""
        directory = self._settings.run_directory(claim.run_id)
        directory.mkdir(parents=True, exist_ok=True)
        gpu = self._quietest_gpu()
        choice = {VISIBLE_VARIABLE: gpu} if gpu is not None else {}
        with (directory / LOG_FILE).open("ab") as log:
            process = subprocess.Popen(
                self._command,
                stdin=subprocess.PIPE,
                stdout=log,
                stderr=subprocess.STDOUT,
                env={**os.environ, **self._settings.as_environment(), **self._share, **choice},
                process_group=0,
                text=True,
            )
        child = LocalChild(process)
        child.tell(claim_to_json(claim))
        if gpu is not None:
            self._given.append((gpu, child))
        return child

    def _quietest_gpu(self) -> str | None:
        """Return the GPU that the fewest living attempts see, or None if there is no choice."""
        if len(self._gpus) < 2:
            return None
        self._given = [(gpu, child) for gpu, child in self._given if child.poll() is None]
        return min(self._gpus, key=[gpu for gpu, _ in self._given].count)
