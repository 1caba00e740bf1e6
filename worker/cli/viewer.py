"""`sldr viewer`: become the host of 3D views."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

import tyro


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(view, prog="sldr viewer", args=list(arguments))


def view() -> int:
    """Serve 3D views of policies to the page until told to end."""
    os.execv(sys.executable, [sys.executable, "-m", "worker.viewer"])
