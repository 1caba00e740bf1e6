"""`python -m worker`: train queued runs on this machine until told to end."""

from __future__ import annotations

import argparse
import logging
import signal
import sys

from backend.store.database import open_database
from backend.store.errors import StoreUnavailable
from backend.store.settings import load_settings
from sldr_core.errors import SldrError
from worker.executors.local import LocalExecutor
from worker.machine import describe_machine, find_gpus
from worker.supervisor import Supervisor


def main() -> int:
    """Run a supervisor; SIGTERM and SIGINT hand its runs back and end it."""
    parser = argparse.ArgumentParser(prog="python -m worker", description="Train queued runs until told to end.")
    parser.add_argument("--slots", type=int, default=1, help="runs trained at the same time (default: 1)")
    slots: int = parser.parse_args().slots
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(message)s")
    settings = load_settings()
    try:
        db = open_database(settings)
        gpus = find_gpus()
        executor = LocalExecutor(settings, gpus=gpus)
        supervisor = Supervisor(db, executor, slots, machine=describe_machine(gpus))
    except (SldrError, StoreUnavailable) as err:
        print(err, file=sys.stderr)
        return 2
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: supervisor.ask_to_stop())
    supervisor.run()
    db.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
