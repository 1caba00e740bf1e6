"""A worker process like `python -m worker`, with short times and fake trainings.

Its arguments say how those behave, and how long its lease lasts [s].
"""

from __future__ import annotations

import signal
import sys
from dataclasses import replace

from fake_trainings import TIMING, fake_command

from backend.store.database import open_database
from backend.store.settings import load_settings
from worker.executors.local import LocalExecutor
from worker.supervisor import Supervisor

if __name__ == "__main__":
    settings = load_settings()
    timing = replace(TIMING, lease_s=float(sys.argv[2]))
    supervisor = Supervisor(open_database(settings), LocalExecutor(settings, fake_command(sys.argv[1])), 1, timing)
    signal.signal(signal.SIGTERM, lambda *_: supervisor.ask_to_stop())
    supervisor.run()
