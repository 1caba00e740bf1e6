"""Processes that make way for trainings, also where the system shares the processor between sessions."""

from __future__ import annotations

import logging
import os
from contextlib import suppress
from pathlib import Path

AUTOGROUP = Path("/proc/self/autogroup")
"""Where Linux tells and takes the niceness of a session as a whole; absent where sessions are not grouped."""

THREADS = Path("/proc/self/task")

log = logging.getLogger("sldr.worker")


def give_way(niceness: int) -> None:
    """Make this process, and what it starts from now on, at least this nice; it may be asked again for more.

    Linux can group processes by session and share the processor between the groups (sched(7), "The autogroup
    feature"): niceness then only counts within a session. So this process leaves its session for one of its own,
    whose niceness is set as well.
    """
    with suppress(PermissionError):
        # Whoever leads a group of processes, as one started from a shell does, cannot leave.
        os.setsid()
    for thread in _threads():
        with suppress(ProcessLookupError):
            os.setpriority(os.PRIO_PROCESS, thread, max(os.getpriority(os.PRIO_PROCESS, thread), niceness))
    if os.getsid(0) != os.getpid() or not AUTOGROUP.exists():
        return
    try:
        AUTOGROUP.write_text(f"{niceness}\n")
    except OSError as err:
        log.info("The niceness of this session stays as it is (%s).", err)


def _threads() -> list[int]:
    """Return every thread of this process: on Linux each has a niceness of its own, and new ones their maker's."""
    return [int(name.name) for name in THREADS.iterdir()] if THREADS.exists() else [0]
