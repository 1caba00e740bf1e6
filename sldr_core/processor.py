"""Which processor this machine has, and how much of it is ours: speed, and numbers to the last bit, depend on both."""

from __future__ import annotations

import os
import platform
from pathlib import Path

CPU_LIST = Path("/proc/cpuinfo")
"""The kernel's list of its processors, where it has one."""

THREADS_VARIABLE = "OMP_NUM_THREADS"
"""How many threads a process is granted, in the words of OpenMP (OpenMP 5.2, section 21.1.2)."""


def processor_model() -> str | None:
    """Return the model of this machine's processors, if it is known."""
    return model_in(CPU_LIST.read_text() if CPU_LIST.is_file() else "")


def model_in(listed: str) -> str | None:
    """Return the model that the kernel's list names, else what the platform calls it, if anything."""
    named = (line.partition(":")[2].strip() for line in listed.splitlines() if line.startswith("model name"))
    return next(named, platform.processor()) or None


def count_cores() -> int:
    """Return how many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def granted_threads() -> int:
    """Return how many threads this process is told to use, or else one for each of its cores."""
    told = os.environ.get(THREADS_VARIABLE, "").partition(",")[0].strip()
    return int(told) if told.isdecimal() and int(told) else count_cores()
