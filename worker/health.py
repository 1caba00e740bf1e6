"""`python -m worker.health`: tell by the exit status whether a worker on this machine shows signs of life."""

from __future__ import annotations

import socket
import sys

from backend.store.database import open_database
from backend.store.errors import StoreUnavailable
from backend.store.settings import load_settings
from backend.store.workers import list_workers


def main() -> int:
    """Return 0 if the store has heard of a worker of this host lately, else 1 and a sentence."""
    host = socket.gethostname()
    try:
        db = open_database(load_settings())
        alive = [worker for worker in list_workers(db) if worker.alive and worker.host == host]
        db.close()
    except StoreUnavailable as err:
        print(err, file=sys.stderr)
        return 1
    if not alive:
        print(f"No worker on {host} has shown life lately.", file=sys.stderr)
    return 0 if alive else 1


if __name__ == "__main__":
    sys.exit(main())
