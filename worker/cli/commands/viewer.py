"""`sldr viewer`: become the host of 3D views, or show one policy."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import tyro

from sldr_core.errors import InvalidConfig


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    return tyro.cli(view, prog="sldr viewer", args=list(arguments))


def view(
    policy: Annotated[Path | None, tyro.conf.arg(metavar="FILE", help_behavior_hint="")] = None,
    port: Annotated[int | None, tyro.conf.arg(metavar="INT", help_behavior_hint="")] = None,
) -> int:
    """Serve 3D views of policies to the page, or show one policy without the service.

    Args:
        policy: Show this policy and nothing else; the address to open is printed.
        port: The port for that (default: a free one).
    """
    if policy is None and port is not None:
        raise InvalidConfig({"port": "views for the page need none; it is for --policy"})
    options = [] if policy is None else ["--policy", str(policy)]
    options += [] if port is None else ["--port", str(port)]
    os.execv(sys.executable, [sys.executable, "-m", "worker.viewer", *options])
