"""The life of 3D sessions, with a real store, real processes, a real Viser server and a real websocket client."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

import httpx
import msgspec
import psutil
import pytest
import viewer_targets
import viser
from sqlalchemy import Connection
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

from backend.store import viewer_sessions
from backend.store.database import Database, open_database
from backend.store.engines import open_engine, parse_address
from backend.store.errors import StoreUnavailable
from backend.store.launches import LaunchOrder, launch
from backend.store.settings import Settings
from sldr_core.config import TASKS
from worker.viewer import host as viewer_host
from worker.viewer.host import Host, Limits
from worker.viewer.process import serve_session

PATIENCE_S = 60.0


@pytest.fixture
def database(settings: Settings) -> Iterator[Database]:
    database = open_database(settings)
    yield database
    database.close()


class LeavingStore(Database):
    """A store that can be away, and that can go away once something was written."""

    is_away = False
    leaves_after_write = False

    @contextmanager
    def read(self) -> Generator[Connection]:
        self._check()
        with super().read() as conn:
            yield conn

    @contextmanager
    def write(self, is_news: bool = True) -> Generator[Connection]:
        self._check()
        with super().write(is_news) as conn:
            yield conn
        self.is_away = self.leaves_after_write

    def _check(self) -> None:
        if self.is_away:
            raise StoreUnavailable("The store cannot be used just now: it is away.")


@pytest.fixture
def store(database: Database, settings: Settings) -> Iterator[LeavingStore]:
    """Return the same store, whose tables `database` has made."""
    store = LeavingStore(open_engine(parse_address(settings.database_url)))
    yield store
    store.close()


@pytest.fixture
def run_id(database: Database, settings: Settings, policy_path: Path) -> str:
    order = LaunchOrder(task="FetchPush", phase="locomotion", method="her", seeds=(0,), preset="smoke", overrides={})
    run_id = launch(database, order)[0]
    directory = settings.run_directory(run_id)
    directory.mkdir(parents=True)
    (directory / "policy-newest.pt").write_bytes(policy_path.read_bytes())
    return run_id


@pytest.fixture
def make_host(database: Database, settings: Settings) -> Iterator[Callable[..., Host]]:
    hosts: list[Host] = []

    def make(target: Callable[..., None], store: Database = database, **limits: Any) -> Host:
        host = Host(store, settings, target=target, limits=Limits(**limits), host_id=f"host-{len(hosts)}")
        host.begin()
        hosts.append(host)
        return host

    yield make
    for host in hosts:
        host.close()


def tick_until(host: Host, database: Database, session_id: str, *states: str) -> viewer_sessions.Session:
    deadline = time.monotonic() + PATIENCE_S
    while time.monotonic() < deadline:
        host.tick()
        session = viewer_sessions.get_session(database, session_id)
        if session.state in states:
            return session
        time.sleep(0.05)
    raise AssertionError(f"still {session.state}: {session.message}")


def tick_while(host: Host, waits: Callable[[], bool]) -> None:
    deadline = time.monotonic() + PATIENCE_S
    while waits():
        assert time.monotonic() < deadline
        host.tick()
        time.sleep(0.05)


def watch(port: int | None) -> ClientConnection:
    """Connect and say where the camera is, as the page does."""
    page = connect(
        f"ws://127.0.0.1:{port}",
        subprotocols=[Subprotocol(f"viser-v{viser.__version__}")],
        compression=None,
        max_size=None,
        proxy=None,
    )
    pose = {"wxyz": (1, 0, 0, 0), "position": (3, 0, 1), "look_at": (0, 0, 0), "up_direction": (0, 0, 1)}
    lens = {"fov": 0.6, "near": 0.01, "far": 100.0, "image_height": 480, "image_width": 640}
    page.send(msgspec.msgpack.encode({"type": "ViewerCameraMessage", **pose, **lens}))
    return page


def test_a_session_is_served_to_a_page_and_ends_after_the_last_one_left(make_host, database, run_id):
    host = make_host(serve_session, idle_s=0.5)
    asked = viewer_sessions.request_session(database, run_id)
    session = tick_until(host, database, asked.id, "ready", "failed")
    assert session.state == "ready", session.message
    assert session.message == "Live: the object moving itself on FetchPush, always with the newest policy."
    assert "<html" in httpx.get(f"http://127.0.0.1:{session.port}/", trust_env=False).text.lower()
    process = host.served[asked.id].process.pid
    with watch(session.port) as page:
        assert len(page.recv(timeout=10)) > 0
        tick_while(host, lambda: host.served[asked.id].clients == 0)
        seen = sum(len(page.recv(timeout=10)) for _ in range(20))
    assert seen > 0
    ended = tick_until(host, database, asked.id, "ended")
    assert ended.message == "Nobody watched for 0 s."
    assert not psutil.pid_exists(process)


def test_a_session_that_nobody_opens_ends(make_host, database, run_id):
    host = make_host(viewer_targets.serve_nothing, unopened_s=0.2)
    asked = viewer_sessions.request_session(database, run_id)
    assert tick_until(host, database, asked.id, "ended").message == "Nobody watched for 0 s."


def test_a_session_ends_after_its_only_client_left(make_host, database, run_id):
    host = make_host(viewer_targets.serve_a_client_who_leaves, idle_s=0.2, unopened_s=60.0)
    asked = viewer_sessions.request_session(database, run_id)
    tick_until(host, database, asked.id, "ended")


def test_a_watched_session_stays(make_host, database, run_id):
    host = make_host(viewer_targets.serve_one_client, idle_s=0.1, unopened_s=2.0)
    asked = viewer_sessions.request_session(database, run_id)
    tick_until(host, database, asked.id, "ready")
    time.sleep(0.4)
    host.tick()
    assert viewer_sessions.get_session(database, asked.id).state == "ready"


def test_a_crash_is_reported_in_one_sentence(make_host, database, run_id):
    host = make_host(viewer_targets.die_at_once)
    asked = viewer_sessions.request_session(database, run_id)
    failed = tick_until(host, database, asked.id, "failed")
    assert failed.message == "The 3D view was ended by SIGKILL; open it again."


def test_a_corrupt_policy_is_named(make_host, database, settings, run_id):
    path = settings.run_directory(run_id) / "policy-newest.pt"
    path.write_bytes(b"not a policy")
    host = make_host(serve_session)
    asked = viewer_sessions.request_session(database, run_id)
    failed = tick_until(host, database, asked.id, "failed")
    assert str(path) in (failed.message or "")


def test_a_run_without_a_policy_fails_at_once(make_host, database, settings, run_id):
    (settings.run_directory(run_id) / "policy-newest.pt").unlink()
    host = make_host(viewer_targets.serve_nothing)
    asked = viewer_sessions.request_session(database, run_id)
    failed = tick_until(host, database, asked.id, "failed")
    assert failed.message == f"Run {run_id} has no policy to watch yet; wait for its first test."


def test_a_file_that_cannot_be_read_ends_its_session_and_no_other(make_host, database, run_id, monkeypatch):
    def refuse(*_: object) -> NoReturn:
        raise PermissionError(errno.EACCES, "Permission denied", "policy-newest.pt")

    host = make_host(viewer_targets.serve_nothing)
    watched = viewer_sessions.request_session(database, run_id)
    tick_while(host, lambda: watched.id not in host.served)
    monkeypatch.setattr(viewer_host, "find_session_files", refuse)
    failed = tick_until(host, database, viewer_sessions.request_session(database, run_id).id, "failed")

    assert "cannot be read ([Errno 13] Permission denied: 'policy-newest.pt')" in (failed.message or "")
    assert watched.id in host.served


def test_a_full_host_ends_the_session_that_was_idle_longest(make_host, database, run_id):
    host = make_host(viewer_targets.serve_nothing, sessions=2)
    asked: list[str] = []
    for _ in range(3):
        asked.append(viewer_sessions.request_session(database, run_id).id)
        tick_until(host, database, asked[-1], "ready")  # Else the second could be idle before the first.
    tick_until(host, database, asked[0], "ended")
    assert set(host.served) == set(asked[1:])


def test_a_host_full_of_watched_sessions_says_so(make_host, database, run_id):
    host = make_host(viewer_targets.serve_one_client, sessions=1)
    first = viewer_sessions.request_session(database, run_id).id
    tick_until(host, database, first, "ready")
    tick_while(host, lambda: host.served[first].clients == 0)
    second = viewer_sessions.request_session(database, run_id).id
    failed = tick_until(host, database, second, "failed")
    assert "being watched; close one" in (failed.message or "")


def test_a_closed_session_s_process_ends(make_host, database, run_id):
    host = make_host(viewer_targets.serve_nothing)
    asked = viewer_sessions.request_session(database, run_id)
    tick_until(host, database, asked.id, "ready")
    process = host.served[asked.id].process.pid
    viewer_sessions.mark_ended(database, asked.id, message="It was closed.")
    host.tick()
    assert not host.served
    assert not psutil.pid_exists(process)


@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGKILL])
def test_no_session_outlives_its_host(database, settings, run_id, how):
    asked = viewer_sessions.request_session(database, run_id)
    (settings.home / "pictures").mkdir()
    for task in TASKS:
        (settings.home / "pictures" / f"{task}.png").touch()  # nothing to draw
    environment = {**os.environ, **settings.as_environment()}
    host = subprocess.Popen([sys.executable, "-m", "worker.viewer"], env=environment)
    try:
        deadline = time.monotonic() + PATIENCE_S
        children: list[psutil.Process] = []
        while viewer_sessions.get_session(database, asked.id).host_id is None or len(children) < 2:
            assert time.monotonic() < deadline
            time.sleep(0.1)
            children = psutil.Process(host.pid).children(recursive=True)
        assert viewer_sessions.is_host_alive(database)
        host.send_signal(how)
        host.wait(PATIENCE_S)
        _, alive = psutil.wait_procs(children, timeout=10)
        assert not alive
    finally:
        host.kill()
        host.wait()
    expected = "ended" if how == signal.SIGTERM else "starting"  # a killed host leaves that to the next one
    assert viewer_sessions.get_session(database, asked.id).state == expected


def test_a_new_host_ends_what_a_killed_one_left_open(make_host, database, run_id):
    asked = viewer_sessions.request_session(database, run_id)
    viewer_sessions.next_requested(database, "killed-host")
    viewer_sessions.mark_ready(database, asked.id, 1234)
    make_host(viewer_targets.serve_nothing)
    ended = viewer_sessions.get_session(database, asked.id)
    assert (ended.state, ended.message) == ("ended", "The 3D viewer was started again; open the view once more.")


def test_a_process_ends_while_the_store_is_away_which_hears_of_it_later(make_host, store, database, run_id):
    # Long enough for a busy machine to tell that the session is ready before nobody has watched it.
    host = make_host(viewer_targets.serve_nothing, store, unopened_s=2.0)
    asked = viewer_sessions.request_session(database, run_id)
    tick_until(host, database, asked.id, "ready")
    process = host.served[asked.id].process.pid
    store.is_away = True
    time.sleep(2.1)
    for _ in range(2):
        with pytest.raises(StoreUnavailable):
            host.tick()
    assert not psutil.pid_exists(process)
    store.is_away = False
    assert tick_until(host, database, asked.id, "ended").message == "Nobody watched for 2 s."
    assert not host.served


def test_a_session_that_gets_ready_while_the_store_is_away_is_ready_later(make_host, store, database, run_id):
    host = make_host(viewer_targets.serve_nothing, store)
    asked = viewer_sessions.request_session(database, run_id)
    tick_while(host, lambda: not host.served)
    assert host.served[asked.id].pipe.poll(PATIENCE_S)
    store.is_away = True
    with pytest.raises(StoreUnavailable):
        host.tick()
    store.is_away = False
    assert tick_until(host, database, asked.id, "ready").port == 1234


def test_a_session_that_was_taken_when_the_store_went_away_is_served_later(make_host, store, database, run_id):
    host = make_host(viewer_targets.serve_nothing, store)
    asked = viewer_sessions.request_session(database, run_id)
    store.leaves_after_write = True
    with pytest.raises(StoreUnavailable):
        host.tick()
    assert viewer_sessions.get_session(database, asked.id).host_id == host.host_id
    store.leaves_after_write = store.is_away = False
    tick_until(host, database, asked.id, "ready")


def test_no_process_is_left_by_a_host_that_closes_while_the_store_is_away(make_host, store, database, run_id):
    host = make_host(viewer_targets.serve_nothing, store)
    for _ in range(2):
        asked = viewer_sessions.request_session(database, run_id)
        tick_until(host, database, asked.id, "ready")
    processes = [served.process.pid for served in host.served.values()]
    store.is_away = True
    with pytest.raises(StoreUnavailable):
        host.close()
    assert not any(psutil.pid_exists(process) for process in processes)
    store.is_away = False
