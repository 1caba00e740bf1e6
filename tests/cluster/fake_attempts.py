"""The command of an attempt that only counts, for workers in other processes, too: those find only what lies here."""

from __future__ import annotations

import sys
from pathlib import Path

FAKE_CHILD = Path(__file__).parents[1] / "worker" / "fake_child.py"


def fake_command(behaviour: str) -> list[str]:
    """Return the command of a child that behaves so."""
    return [sys.executable, str(FAKE_CHILD), behaviour]
