"""What a signal is called, for sentences about processes that were ended by one."""

from __future__ import annotations

import signal


def name_signal(number: int) -> str:
    """Return the name of a signal, or its number in words: most real-time signals have no name."""
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"
