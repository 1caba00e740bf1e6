"""Importing what sessions need before anybody asks for one: their processes are forked from one that has it all."""

from __future__ import annotations

import multiprocessing
import threading
from multiprocessing import forkserver

WARM_MODULES = ["worker.viewer.warm"]
"""What the process that sessions are forked from imports beforehand."""


def keep_warm() -> threading.Event:
    """Start the process from which sessions are forked; it ends with this one, whichever way.

    Returns:
        What is set once it has imported everything. To ask it for a session before would mean to wait, and a host that
        waits gives no sign of life.
    """
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(WARM_MODULES)
    forkserver.ensure_running()
    is_warm = threading.Event()
    threading.Thread(target=_wait_until_warm, args=(is_warm,), name="warming", daemon=True).start()
    return is_warm


def _wait_until_warm(is_warm: threading.Event) -> None:
    try:
        probe = multiprocessing.get_context("forkserver").Process(target=_do_nothing)
        probe.start()
        probe.join()
    finally:
        is_warm.set()


def _do_nothing() -> None:
    """End at once."""
