"""`python -m worker`: train queued runs, on this machine or on a cluster, until told to end."""

from __future__ import annotations

import argparse
import signal
import sys

from backend.logs import load_style, start_logging
from backend.store.database import Database, open_database
from backend.store.settings import Settings, load_settings
from sldr_core.errors import InvalidConfig
from worker.executors.local import LocalExecutor
from worker.executors.ray_needs import CORES_OF_A_RUN
from worker.machine import describe_machine, find_gpus, share_of_threads
from worker.sentences import tell
from worker.supervisor import Supervisor


def main() -> int:
    """Run a supervisor; SIGTERM and SIGINT hand its runs back and end it."""
    options = _parse()
    settings = load_settings()
    try:
        start_logging("worker", settings.logs_directory, load_style())
        db = open_database(settings)
        make = {"local": _work_here, "ray": _work_on_cluster}[options.executor]
        supervisor = make(options, db, settings)
    except KeyboardInterrupt:
        return 0
    except Exception as err:
        return tell(err)
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: supervisor.ask_to_stop())
    supervisor.run()
    db.close()
    return 0


def _parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m worker", description="Train queued runs until told to end.")
    parser.add_argument(
        "--slots", type=int, help="runs trained at the same time (default: 1; on a cluster: all that fit)"
    )
    parser.add_argument("--executor", choices=("local", "ray"), default="local", help="where to train")
    parser.add_argument("--address", help="host:port of the cluster's head")
    parser.add_argument(
        "--cores", type=int, default=CORES_OF_A_RUN, help="cores of a run on a cluster that names no threads"
    )
    return parser.parse_args()


def _work_here(options: argparse.Namespace, db: Database, settings: Settings) -> Supervisor:
    gpus, slots = find_gpus(), 1 if options.slots is None else options.slots
    executor = LocalExecutor(settings, gpus=gpus, threads=share_of_threads(max(1, slots)))
    return Supervisor(db, executor, slots, machine=describe_machine(gpus))


def _work_on_cluster(options: argparse.Namespace, db: Database, settings: Settings) -> Supervisor:
    if options.address is None:
        raise InvalidConfig({"address": "name the cluster's head as host:port; `sldr node --head` prints it"})
    from worker.executors import ray_access  # Ray is an extra, and slow to import.

    ray_access.connect(options.address, settings.home)
    from worker.executors.ray import RayExecutor

    executor = RayExecutor(settings, options.cores)
    slots = executor.count_slots() if options.slots is None else options.slots
    return Supervisor(db, executor, slots, machine=executor.describe())


if __name__ == "__main__":
    sys.exit(main())
