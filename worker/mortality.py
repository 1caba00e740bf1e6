"""Processes that do not outlive the one that started them, however that one ends."""

from __future__ import annotations

import ctypes
import signal
import sys

PR_SET_PDEATHSIG = 1
"""Number of the Linux call that asks for a signal when the parent dies (prctl(2))."""


def end_with_parent() -> None:
    """Let the system kill this process when its parent dies. Elsewhere than on Linux it does nothing."""
    if sys.platform == "linux":
        ctypes.CDLL(None, use_errno=True).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
