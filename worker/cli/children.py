"""Child processes that belong to this one: started again when they die, ended with it."""

from __future__ import annotations

import ctypes
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence

from worker.exit_words import describe_exit
from worker.mortality import PR_SET_PDEATHSIG

FIRST_PAUSE_S = 0.5
"""Pause before a child that died is started again; doubled each time it dies young [s]."""

LONGEST_PAUSE_S = 30.0
"""The pause grows no further than this [s]."""

GROWN_UP_S = 30.0
"""A child that lived this long did not die young [s]."""


class Child:
    """Keep one process running."""

    def __init__(self, name: str, command: Sequence[str], environment: Mapping[str, str]) -> None:
        self.name = name
        self.deaths_in_youth = 0
        """How often in a row it died young."""
        self._command = list(command)
        self._environment = dict(environment)
        self._process: subprocess.Popen[bytes] | None = None
        self._started_at = 0.0
        self._start_at = 0.0

    @property
    def pid(self) -> int | None:
        """The process, or None while it waits to be started again."""
        return self._process.pid if self._process else None

    def keep_alive(self, tell: Callable[[str], None]) -> None:
        """Start the process if it is due, and notice its death. Returns at once.

        Args:
            tell: takes one sentence for the user.
        """
        now = time.monotonic()
        if self._process is None:
            if now >= self._start_at:
                self._start()
        elif (code := self._process.poll()) is not None:
            self._process = None
            grown_up = now - self._started_at >= GROWN_UP_S
            self.deaths_in_youth = 0 if grown_up else self.deaths_in_youth + 1
            pause = min(FIRST_PAUSE_S * 2 ** max(0, self.deaths_in_youth - 1), LONGEST_PAUSE_S)
            self._start_at = now + pause
            tell(f"The {self.name} {describe_exit(code)}; starting it again in {pause:g} s.")

    def ask_to_end(self) -> None:
        """Send SIGTERM."""
        if self._process:
            self._process.terminate()

    @property
    def has_ended(self) -> bool:
        """Whether no process runs just now."""
        return self._process is None or self._process.poll() is not None

    def wait(self, until: float) -> None:
        """Wait for its end until a monotonic time [s], then kill it."""
        if not self._process:
            return
        try:
            self._process.wait(max(0.0, until - time.monotonic()))
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def _start(self) -> None:
        # A session of its own: a Ctrl-C in the terminal reaches only the parent, which ends its children in order.
        self._process = subprocess.Popen(
            self._command, env=self._environment, start_new_session=True, preexec_fn=_die_with(os.getpid())
        )
        self._started_at = time.monotonic()


def _die_with(parent: int) -> Callable[[], None] | None:
    """Return what a child calls before it starts, so that it gets SIGTERM when `parent` ends however it ends."""
    if sys.platform != "linux":
        return None
    libc = ctypes.CDLL(None, use_errno=True)

    def prepare() -> None:
        libc.prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
        if os.getppid() != parent:
            os._exit(1)

    return prepare
