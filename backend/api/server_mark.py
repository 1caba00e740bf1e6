"""Where the service of a data directory is found: a file with its address, locked as long as it runs.

Commands and scripts on this machine read it; a file that nobody holds is left from a service that has ended.
"""

from __future__ import annotations

import fcntl
import logging
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import IO

from backend.store.settings import Settings

WILDCARDS = {"": "127.0.0.1", "0.0.0.0": "127.0.0.1", "::": "::1"}
"""How a program on this machine reaches a service that listens on every address."""

TRIES = 5
"""A command that looks at the file holds its lock for an instant, so taking it is tried again."""
PAUSE_S = 0.1
"""Between two tries [s]."""

log = logging.getLogger(__name__)


def local_url(host: str, port: int) -> str:
    """Return where a program on this machine finds a service."""
    name = WILDCARDS.get(host, host)
    return f"http://[{name}]:{port}" if ":" in name else f"http://{name}:{port}"


@contextmanager
def marked(settings: Settings, url: str) -> Iterator[None]:
    """Say in the data directory that a service runs over it; of several, the first is named."""
    settings.home.mkdir(parents=True, exist_ok=True)
    with settings.server_file.open("a+") as file:
        if not _take(file):
            log.info("Another service runs over %s; commands on this machine ask that one.", settings.home)
            yield
            return
        file.truncate(0)
        file.write(f"{url}\n")
        file.flush()
        yield
        file.truncate(0)


def _take(file: IO[str]) -> bool:
    """Return whether nobody else holds the lock, which is then held here."""
    for turn in range(TRIES):
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            if turn < TRIES - 1:
                time.sleep(PAUSE_S)
        else:
            return True
    return False
