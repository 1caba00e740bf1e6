"""A worker process like `python -m worker --executor ray`, with short times and fake trainings."""

from __future__ import annotations

import signal
import sys
from pathlib import Path

from fake_attempts import fake_command

from backend.store.database import open_database
from backend.store.settings import load_settings
from worker.executors.ray_access import connect
from worker.supervisor import Supervisor, Timing

TIMING = Timing(poll_s=0.05, heartbeat_s=0.2, reap_s=0.1, cancel_grace_s=0.5, stop_grace_s=5.0, retry_backoff_s=0.0)

if __name__ == "__main__":
    address, token_home, behaviour = sys.argv[1:]
    connect(address, Path(token_home))
    from worker.executors.ray import RayExecutor

    settings = load_settings()
    supervisor = Supervisor(open_database(settings), RayExecutor(settings, 1, fake_command(behaviour)), 2, TIMING)
    signal.signal(signal.SIGTERM, lambda *_: supervisor.ask_to_stop())
    supervisor.run()
