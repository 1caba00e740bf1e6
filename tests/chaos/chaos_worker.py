"""A worker as `python -m worker` is one, with a short lease: `python chaos_worker.py SLOTS LEASE_S [CHILD ...]`."""

from __future__ import annotations

import logging
import signal
import sys

from backend.store.database import open_database
from backend.store.settings import load_settings
from worker.executors.local import CHILD_COMMAND, LocalExecutor
from worker.patience import insist
from worker.supervisor import Supervisor, Timing

BEATS_PER_LEASE = 6.0
"""As in the real thing: a lease of 60 s, renewed every 10 s."""


def main() -> None:
    """Work until SIGTERM."""
    slots, lease_s, command = int(sys.argv[1]), float(sys.argv[2]), sys.argv[3:]
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(message)s", stream=sys.stdout)
    settings = load_settings()
    timing = Timing(poll_s=0.2, heartbeat_s=lease_s / BEATS_PER_LEASE, lease_s=lease_s, reap_s=1.0, retry_backoff_s=0.2)
    executor = LocalExecutor(settings, command or CHILD_COMMAND)
    supervisor = Supervisor(insist(lambda: open_database(settings)), executor, slots, timing)
    signal.signal(signal.SIGTERM, lambda *_: supervisor.ask_to_stop())
    supervisor.run()


if __name__ == "__main__":
    main()
