"""What the end of a process tells about its attempt, when the process itself has told the store nothing."""

from __future__ import annotations

import signal

from backend.store.outcomes import Failed, Lost

OWN_FAULTS = frozenset({signal.SIGABRT, signal.SIGBUS, signal.SIGFPE, signal.SIGILL, signal.SIGSEGV, signal.SIGTRAP})
"""Signals that a process earns by what it does; all others come from outside."""


def failure_of(status: int) -> Failed | Lost:
    """Put an exit status (a negative signal number if it was killed) into an outcome that allows another attempt."""
    if status >= 0:
        return Failed(f"Its process ended early with exit status {status}; the log says more.", retry=True)
    try:
        number = signal.Signals(-status)
    except ValueError:
        return Lost(f"Its process was killed by signal {-status}.")
    if number in OWN_FAULTS:
        return Failed(f"Its process was killed by {number.name}; the log says more.", retry=True)
    hint = " (the machine may be out of memory)" if number is signal.SIGKILL else ""
    return Lost(f"Its process was killed by {number.name}{hint}.")
