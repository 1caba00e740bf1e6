"""What 3D sessions cost: time to open, updates and CPU while watched, and what is left of twenty that were opened.

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

import msgspec
import psutil
import viser
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

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
        before, started = process.cpu_times(), time.monotonic()
        updates = drain(page, WATCHED_S)
        seconds, after = time.monotonic() - started, process.cpu_times()
        cpu = (after.user + after.system - before.user - before.system) / seconds
        memory = process.memory_full_info().uss / 2**20
    viewer_sessions.mark_ended(database, session.id)
    host.tick()
    return (
        f"open in {opening_s:.2f} s, {updates / seconds:.1f} updates/s, {100 * cpu:.0f} % of a core, "
        f"{memory:.0f} MiB of its own"
    )


def watch(port: int | None) -> ClientConnection:
    """Connect with a 3D page's server and say where the camera is, as the page does."""
    protocol = Subprotocol(f"viser-v{viser.__version__}")
    page = connect(f"ws://127.0.0.1:{port}", subprotocols=[protocol], compression=None, max_size=None, proxy=None)
    pose = {"wxyz": (1, 0, 0, 0), "position": (3, 0, 1), "look_at": (0, 0, 0), "up_direction": (0, 0, 1)}
    lens = {"fov": 0.6, "near": 0.01, "far": 100.0, "image_height": 480, "image_width": 640}
    page.send(msgspec.msgpack.encode({"type": "ViewerCameraMessage", **pose, **lens}))
    return page


def drain(page: ClientConnection, seconds: float) -> int:
    """Read what comes for a while; return how many messages that were. One holds all that moved in a frame."""
    count, ends_at = 0, time.monotonic() + seconds
    while (left := ends_at - time.monotonic()) > 0:
        try:
            page.recv(timeout=left)
            count += 1
        except TimeoutError:
            break
    return count


def leave_many(host: Host, database: Database, run_id: str) -> str:
    """Open sessions, leave them, and say what they left behind once they had ended by themselves."""
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
    return f"{OPENED} sessions opened and left: {len(left)} processes and {len(listening & set(ports))} ports remain"


if __name__ == "__main__":
    main(sys.argv[1:] or ["FetchPush", "HandBlockRotate"])
