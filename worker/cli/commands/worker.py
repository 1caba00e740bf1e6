"""`sldr worker`: become the supervisor that trains queued runs."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

import tyro

from sldr_core.errors import InvalidConfig


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(work, prog="sldr worker", args=list(arguments))


def work(slots: int = 1) -> int:
    """Train queued runs on this machine until told to end.

    Args:
        slots: Runs trained at the same time.
    """
    if slots < 1:
        raise InvalidConfig({"slots": f"a worker needs at least 1, got {slots}"})
    os.execv(sys.executable, [sys.executable, "-m", "worker", "--slots", str(slots)])
