"""What every test may use: a browser that is there already, and a port that is free."""

from __future__ import annotations

import os
import socket
from collections.abc import Callable
from typing import Any

import pytest

CHROMIUM_ARGUMENTS = [
    "--no-sandbox",  # tests may run as root, in a container
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-dev-shm-usage",
    "--enable-unsafe-swiftshader",  # 3D without a graphics card
]


@pytest.fixture(scope="session")
def chromium_path() -> str:
    """Return the browser that is installed here; nothing is downloaded."""
    return os.environ.get("SLDR_CHROMIUM", "/usr/bin/chromium")


@pytest.fixture(scope="session")
def browser_type_launch_args(chromium_path: str) -> dict[str, Any]:
    """Tell pytest-playwright which browser to start, and how."""
    return {"executable_path": chromium_path, "args": CHROMIUM_ARGUMENTS}


@pytest.fixture(scope="session")
def base_url() -> None:
    """Stand in for pytest-playwright's own fixture, which pytest 9.2 warns about; tests name whole addresses."""


@pytest.fixture(scope="session")
def find_free_port() -> Callable[[], int]:
    """Return a way to find ports on which nothing listens."""

    def find() -> int:
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            return probe.getsockname()[1]

    return find


@pytest.fixture
def free_port(find_free_port: Callable[[], int]) -> int:
    """Return a port on which nothing listens."""
    return find_free_port()
