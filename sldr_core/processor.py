"""Which processor this machine has: how fast it trains, and its numbers to the last bit, depend on it."""

from __future__ import annotations

import platform
from pathlib import Path

CPU_LIST = Path("/proc/cpuinfo")
"""The kernel's list of its processors, where it has one."""


def processor_model() -> str | None:
    """Return the model of this machine's processors, if it is known."""
    return model_in(CPU_LIST.read_text() if CPU_LIST.is_file() else "")


def model_in(listed: str) -> str | None:
    """Return the model that the kernel's list names, else what the platform calls it, if anything."""
    named = (line.partition(":")[2].strip() for line in listed.splitlines() if line.startswith("model name"))
    return next(named, platform.processor()) or None
