"""A worker process like `python -m worker`, with short times and fake trainings."""

from __future__ import annotations

import signal
import sys

from worker_cases import TIMING, fake_command

from backend.store.database import open_database
from backend.store.settings import load_settings
from worker.executors.local import LocalExecutor
from worker.supervisor import Supervisor

if __name__ == "__main__":
    settings = load_settings()
    supervisor = Supervisor(open_database(settings), LocalExecutor(settings, fake_command(sys.argv[1])), 1, TIMING)
    signal.signal(signal.SIGTERM, lambda *_: supervisor.ask_to_stop())
    supervisor.run()
