"""`sldr viewer`: become the host of 3D views, or show one policy; the options are those of `worker.viewer`."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    os.execv(sys.executable, [sys.executable, "-m", "worker.viewer", *arguments])
