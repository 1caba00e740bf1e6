"""Processes beside the one that tests: whether they run, and waiting for what they do."""

from __future__ import annotations

import time
from collections.abc import Callable

import psutil

PATIENCE_S = 180.0
"""Long, because the machine that runs the tests may be busy with others [s]."""

LOOK_EVERY_S = 0.02


def wait_until(is_so: Callable[[], bool], patience_s: float = PATIENCE_S, otherwise: str = "") -> None:
    """Wait for something to come true.

    Args:
        is_so: tells whether it has.
        patience_s: how long it may take [s].
        otherwise: what to say when it has not.

    Raises:
        AssertionError: it did not come true in time.
    """
    give_up_at = time.monotonic() + patience_s
    while not is_so():
        assert time.monotonic() < give_up_at, otherwise or f"it did not come true in {patience_s:g} s"
        time.sleep(LOOK_EVERY_S)


def is_running(pid: int) -> bool:
    """Tell whether a process is there and no zombie."""
    try:
        return psutil.Process(pid).status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False
