"""`python -m worker.health`, which a container is watched by."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
from pathlib import Path

from backend.store.database import open_database
from backend.store.settings import Settings, sqlite_url
from backend.store.workers import register_worker, retire


def check(settings: Settings) -> tuple[int, str]:
    done = subprocess.run(
        [sys.executable, "-m", "worker.health"],
        env={**os.environ, **settings.as_environment()},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, done.stderr


def test_a_machine_is_well_while_a_worker_on_it_shows_life(tmp_path: Path) -> None:
    settings = Settings(home=tmp_path, database_url=sqlite_url(tmp_path))
    db = open_database(settings)
    register_worker(db, "another-machine", os.getpid(), 1)
    without = check(settings)
    worker_id = register_worker(db, socket.gethostname(), os.getpid(), 1)
    alive = check(settings)
    retire(db, worker_id)
    ended = check(settings)
    db.close()

    assert without == (1, f"No worker on {socket.gethostname()} has shown life lately.\n")
    assert alive == (0, "")
    assert ended == without
