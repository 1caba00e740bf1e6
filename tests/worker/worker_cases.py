"""Workers in this process and in others, and waiting for what they do."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from fake_trainings import TIMING, fake_command
from other_processes import wait_until

from backend.store.database import Database
from backend.store.launches import LaunchOrder, launch
from backend.store.metrics import read_metrics
from backend.store.runs import RunRow, get_run
from backend.store.settings import Settings
from backend.store.states import RunState
from worker.executors import Executor
from worker.executors.local import LocalExecutor
from worker.supervisor import Supervisor, Timing

HERE = Path(__file__).parent


@contextmanager
def worker(
    db: Database, settings: Settings, behaviour: str, timing: Timing = TIMING, executor: Executor | None = None
) -> Generator[Supervisor]:
    """Run a supervisor in a thread for as long as the block lasts."""
    supervisor = Supervisor(db, executor or LocalExecutor(settings, fake_command(behaviour)), 1, timing)
    thread = threading.Thread(target=supervisor.run)
    thread.start()
    try:
        yield supervisor
    finally:
        supervisor.ask_to_stop()
        supervisor.ask_to_stop()
        thread.join()


@contextmanager
def worker_process(
    settings: Settings, behaviour: str, lease_s: float = TIMING.lease_s
) -> Generator[subprocess.Popen[bytes]]:
    """Run a supervisor in a process of its own."""
    command = [sys.executable, str(HERE / "fake_worker.py"), behaviour, str(lease_s)]
    process = subprocess.Popen(command, env={**os.environ, **settings.as_environment()})
    try:
        yield process
    finally:
        process.kill()
        process.wait()


def queued_run(db: Database, seed: int = 0) -> str:
    """Queue a run that needs no other."""
    return launch(db, LaunchOrder("FetchPush", "manipulation", "her", [seed], "smoke"))[0]


def wait_for_state(db: Database, run_id: str, state: RunState) -> RunRow:
    """Wait until a run is in a state."""
    wait_until(lambda: get_run(db, run_id).state is state)
    return get_run(db, run_id)


def wait_for_training(db: Database, settings: Settings, run_id: str) -> int:
    """Wait until a run's child has logged something; return the child's process id."""
    wait_until(lambda: bool(read_metrics(db, run_id).step))
    begun = [line for line in read_log(settings, run_id).splitlines() if "begins in process" in line]
    return int(begun[-1].rstrip(".").split()[-1])


def read_log(settings: Settings, run_id: str) -> str:
    """Return what the run's processes have said."""
    return (settings.run_directory(run_id) / "log.txt").read_text()
