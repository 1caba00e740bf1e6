"""How a process has ended, in words."""

from __future__ import annotations

import signal


def describe_exit(exit_code: int | None) -> str:
    """Return what an exit code says, to go behind the name of a process; a negative one is the signal that ended it."""
    if exit_code is not None and exit_code < 0:
        return f"was ended by {_name_signal(-exit_code)}"
    return f"ended with exit code {exit_code}"


def _name_signal(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:  # most real-time signals have no name
        return f"signal {number}"
