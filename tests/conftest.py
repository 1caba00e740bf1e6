"""What every test may use: a browser that is there already, a port that is free, and a store on either engine."""

from __future__ import annotations

import os
import socket
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from postgres_server import PostgresServer
from store_engines import PostgresStores, SqliteStores, Stores
from xdist.scheduler import LoadFileScheduling

from backend.store.database import Database, open_database
from backend.store.settings import Settings

CHROMIUM_ARGUMENTS = [
    "--no-sandbox",  # tests may run as root, in a container
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-dev-shm-usage",
    "--enable-unsafe-swiftshader",  # 3D without a graphics card
]

# What a launch queues, and what a page offers, must not depend on what is shipped.
os.environ["SLDR_ZOO"] = os.environ["SLDR_SAMPLE_STUDY"] = "/nonexistent"

TOGETHER = {
    "cluster": ("cluster/test_*.py",),
    "whole product": (
        "browser/test_first_run.py",
        "browser/test_pause_and_delete.py",
        "browser/test_study.py",
        "browser/test_transport.py",
    ),
    "pages": ("browser/test_*.py",),
}
"""Files that share what is dear to start - a cluster, a service that trains and draws, a browser - stay in one process.
The first that fits counts."""

LONGEST_FIRST = (
    "whole product",
    "cluster",
    "chaos",
    "worker",
    "core",
    "security",
    "pages",
    "cli",
    "viewer",
    "media",
    "tasks",
)
"""What takes long begins first, so that at the end no process is left alone with it: those above, and rooms."""


def share_of(file: Path) -> str | None:
    """Return with which others a file's tests stay in one process; None if they need nobody."""
    return next((name for name, patterns in TOGETHER.items() if any(map(file.match, patterns))), None)


class RoomScheduling(LoadFileScheduling):
    """Keep each file in one process, and with it those that share something."""

    def _split_scope(self, nodeid: str) -> str:
        file = nodeid.partition("::")[0]
        return share_of(Path(file)) or file


def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> RoomScheduling:
    """Hand out tests by what they share, and by files."""
    return RoomScheduling(config, log)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Order tests by what takes long; besides they stay as they were."""
    rank = {name: place for place, name in enumerate(LONGEST_FIRST)}
    items.sort(key=lambda item: rank.get(share_of(item.path) or item.path.parent.name, len(rank)))


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


@pytest.fixture(scope="session")
def sqlite_stores(tmp_path_factory: pytest.TempPathFactory) -> SqliteStores:
    """Return a way to get fresh SQLite stores."""
    return SqliteStores(tmp_path_factory.mktemp("sqlite"))


@pytest.fixture(scope="session")
def postgres_server() -> Iterator[PostgresServer]:
    """Return a running PostgreSQL server."""
    server = PostgresServer()
    server.start()
    yield server
    server.stop()
    server.remove()


@pytest.fixture(scope="session")
def postgres_stores(postgres_server: PostgresServer, tmp_path_factory: pytest.TempPathFactory) -> PostgresStores:
    """Return a way to get fresh PostgreSQL stores."""
    return PostgresStores(postgres_server, tmp_path_factory.mktemp("postgresql"))


@pytest.fixture(scope="module")
def engine() -> str:
    """Return the engine of the test's store; rooms and tests that want both parametrise it.

    Not longer than for a module: `stores` would keep the engine of another room's tests.
    """
    return "sqlite"


@pytest.fixture(scope="module")
def stores(engine: str, request: pytest.FixtureRequest) -> Stores:
    """Return a way to get fresh stores on the test's engine."""
    return request.getfixturevalue("sqlite_stores" if engine == "sqlite" else "postgres_stores")


@pytest.fixture
def settings(stores: Stores, tmp_path: Path) -> Iterator[Settings]:
    """Return a fresh data directory with an empty store."""
    with stores.fresh(tmp_path) as settings:
        yield settings


@pytest.fixture
def db(settings: Settings) -> Iterator[Database]:
    """Return the store of the test's data directory."""
    database = open_database(settings)
    yield database
    database.close()
