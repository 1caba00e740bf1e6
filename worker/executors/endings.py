"""What the end of a process tells about its attempt, when the process itself has told the store nothing."""

from __future__ import annotations

import signal

from backend.store.queue import Failed


def failure_of(status: int) -> Failed:
    """Put an exit status (a negative signal number if it was killed) into a failure that is worth another attempt."""
    if status >= 0:
        return Failed(f"Its process ended early with exit status {status}; the log says more.", retry=True)
    try:
        name = signal.Signals(-status).name
    except ValueError:
        name = f"signal {-status}"
    hint = " (the machine may be out of memory)" if name == "SIGKILL" else ""
    return Failed(f"Its process was killed by {name}{hint}.", retry=True)
