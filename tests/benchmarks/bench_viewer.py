"""What 3D sessions cost: time to open, updates and CPU while watched, a training beside them, and what twenty leave.

    .venv/bin/python tests/benchmarks/bench_viewer.py [FetchPush HandBlockRotate ...]

Sessions are those of the product: a real host, real processes, a policy with random weights, and a client that connects
as the page does. Run it on a quiet machine; figures are of this process's children alone.
"""

from __future__ import annotations

import sys
import tempfile
import time
from contextlib import closing
from pathlib import Path

import psutil
from bench_pages import drain, watch
from bench_watching import measure_slowing

from backend.store import viewer_sessions
from backend.store.database import Database, open_database
from backend.store.launches import LaunchOrder, launch
from backend.store.settings import Settings, sqlite_url
from sldr_core.presets import make_config
from sldr_core.training.build import build_training
from sldr_core.training.checkpoint import Counters
from sldr_core.training.policy import write_policy
from worker.viewer.host import Host, Limits
from worker.viewer.process import serve_session
from worker.viewer.warming import keep_warm

WATCHED_S = 15.0
"""How long a session is watched for its figures [s]."""

OPENED = 20
"""Sessions that are opened and left."""

PATIENCE_S = 120.0


def main(tasks: list[str]) -> None:
    """Print one line for each task, then what twenty sessions leave behind."""
    with tempfile.TemporaryDirectory() as home:
        settings = Settings(home=Path(home), database_url=sqlite_url(Path(home)))
        database = open_database(settings)
        runs = {task: prepare(database, settings, task) for task in tasks}
        keep_warm().wait()
        host = Host(database, settings, target=serve_session, limits=Limits(sessions=OPENED, unopened_s=10.0))
        host.begin()
        for task, run_id in runs.items():
            print(f"{task}: {measure(host, database, run_id)}", flush=True)
        pair = [*runs.values(), *runs.values()][:2]
        print(slow_a_training(host, database, pair, Path(home) / "training"), flush=True)
        print(leave_many(host, database, runs[tasks[0]]))
        host.close()
        database.close()


def prepare(database: Database, settings: Settings, task: str) -> str:
    """Return a run of a task that has a policy with random weights."""
    order = LaunchOrder(task=task, phase="manipulation", method="her", seeds=(0,), preset="smoke", overrides={})
    run_id = launch(database, order)[0]
    directory = settings.run_directory(run_id)
    directory.mkdir(parents=True)
    config = make_config(task, "manipulation", "her", 0, "smoke")
    write_policy(directory / "policy-newest.pt", build_training(config, directory, ()), Counters(cycle=2))
    return run_id


def measure_opening(host: Host, database: Database, run_id: str) -> tuple[viewer_sessions.Session, float]:
    """Open a session; return it once it is ready, and the seconds that took."""
    asked_at = time.monotonic()
    asked = viewer_sessions.request_session(database, run_id)
    while time.monotonic() < asked_at + PATIENCE_S:
        host.tick()
        session = viewer_sessions.get_session(database, asked.id)
        if session.state == "failed":
            raise SystemExit(f"the session failed: {session.message}")
        if session.state != "starting":
            return session, time.monotonic() - asked_at
        time.sleep(0.02)
    raise TimeoutError("the session did not open")


def measure(host: Host, database: Database, run_id: str) -> str:
    """Watch one session for a while, and say what it cost."""
    session, opening_s = measure_opening(host, database, run_id)
    process = psutil.Process(host.served[session.id].process.pid)
    with closing(watch(session.port)) as page:
        drain(page, 2.0)  # meshes first
        before = cpu_seconds(process)
        seen = drain(page, WATCHED_S)
        cpu_s = cpu_seconds(process) - before
        memory = process.memory_full_info().uss / 2**20
    viewer_sessions.mark_ended(database, session.id)
    host.tick()
    moved = f"{seen.rate:.1f} updates/s while it moves, {1000 * cpu_s / seen.updates:.1f} ms of CPU each"
    cost = f"{100 * cpu_s / seen.seconds:.0f} % of a core, {memory:.0f} MiB of its own"
    return f"open in {opening_s:.2f} s, {moved}, {cost}"


def cpu_seconds(process: psutil.Process) -> float:
    """Return the CPU time that a process has used [s]."""
    times = process.cpu_times()
    return times.user + times.system


def slow_a_training(host: Host, database: Database, run_ids: list[str], directory: Path) -> str:
    """Train beside two open sessions, which are watched in turns."""
    sessions = [measure_opening(host, database, run_id)[0] for run_id in run_ids]
    text = measure_slowing(directory, [session.port for session in sessions if session.port is not None])
    for session in sessions:
        viewer_sessions.mark_ended(database, session.id)
    host.tick()
    return text


def leave_many(host: Host, database: Database, run_id: str) -> str:
    """Open sessions, leave them, and say what they left behind once they had ended by themselves."""
    before = own_memory()
    ports: list[int] = []
    pids: list[int] = []
    for _ in range(OPENED):
        session, _ = measure_opening(host, database, run_id)
        ports += [port for port in (session.port, session.control_port) if port is not None]
        pids += [served.process.pid for served in host.served.values() if served.process.pid is not None]
    ends_at = time.monotonic() + PATIENCE_S
    while host.served and time.monotonic() < ends_at:
        host.tick()
        time.sleep(0.05)
    left = [pid for pid in set(pids) if psutil.pid_exists(pid)]
    listening = {
        each.laddr.port for each in psutil.net_connections("tcp") if each.laddr and each.status == psutil.CONN_LISTEN
    }
    return (
        f"{OPENED} sessions opened and left: {len(left)} processes, {len(listening & set(ports))} ports and "
        f"{own_memory() - before:.0f} MiB remain"
    )


def own_memory() -> float:
    """Return the memory of this process and all below it that nothing else uses [MiB]."""
    here = psutil.Process()
    return sum(each.memory_full_info().uss for each in (here, *here.children(recursive=True))) / 2**20


if __name__ == "__main__":
    main(sys.argv[1:] or ["FetchPush", "HandBlockRotate"])
