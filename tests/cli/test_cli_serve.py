"""`sldr serve`: its children, their lives and their ends. All processes are real."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import httpx
import psutil
import pytest
from other_processes import is_running, wait_until

from worker.cli import children
from worker.cli.children import Child
from worker.cli.commands.serve import CannotServe, keep

SLEEPER = (sys.executable, "-c", "import time; time.sleep(60)")
FAILING = (sys.executable, "-c", "raise SystemExit(3)")
STUBBORN = (
    sys.executable,
    "-c",
    "import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); print('deaf', flush=True); time.sleep(60)",
)
PATIENCE_S = 60.0


@pytest.fixture
def told() -> list[str]:
    """Return where children tell what happens to them."""
    return []


@pytest.fixture
def sleeper(told: list[str], monkeypatch: pytest.MonkeyPatch) -> Iterator[Child]:
    """Return a child that would run for long."""
    monkeypatch.setattr(children, "FIRST_PAUSE_S", 0.05)
    child = Child("sleeper", SLEEPER, os.environ)
    child.keep_alive(told.append)
    yield child
    child.ask_to_end()
    child.wait(time.monotonic() + 5)


def test_a_child_that_is_killed_is_started_again(sleeper: Child, told: list[str]):
    first = sleeper.pid
    assert first is not None
    os.kill(first, signal.SIGKILL)

    def is_back() -> bool:
        sleeper.keep_alive(told.append)
        return sleeper.pid not in (first, None)

    wait_until(is_back)
    assert told == ["The sleeper was ended by SIGKILL; starting it again in 0.05 s."]


def test_a_child_that_dies_again_and_again_waits_longer_each_time(told: list[str], monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(children, "FIRST_PAUSE_S", 0.01)
    child = Child("failing one", FAILING, os.environ)

    def died_thrice() -> bool:
        child.keep_alive(told.append)
        return len(told) == 3

    wait_until(died_thrice)
    assert told[2] == "The failing one ended with exit code 3; starting it again in 0.04 s."
    assert child.deaths_in_youth == 3


def test_a_child_that_does_not_listen_is_killed():
    child = Child("stubborn one", STUBBORN, os.environ)
    child.keep_alive(print)
    pid = child.pid
    assert pid is not None
    child.ask_to_end()
    child.wait(time.monotonic() + 0.2)
    assert not is_running(pid)


def test_children_do_not_outlive_a_parent_that_is_killed():
    program = (
        "import os, sys, time\n"
        "from worker.cli.children import Child\n"
        f"child = Child('sleeper', {SLEEPER!r}, os.environ)\n"
        "child.keep_alive(print)\n"
        "print(child.pid, flush=True)\n"
        "time.sleep(60)\n"
    )
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as parent:
        assert parent.stdout is not None
        orphan = int(parent.stdout.readline())
        assert is_running(orphan)
        parent.kill()
    wait_until(lambda: not is_running(orphan), patience_s=5)


def test_a_child_that_a_signal_without_a_name_ended_is_told_and_started_again(sleeper: Child, told: list[str]):
    assert sleeper.pid is not None
    os.kill(sleeper.pid, signal.SIGRTMIN + 5)
    wait_until(lambda: sleeper.has_ended)
    sleeper.keep_alive(told.append)
    assert told == [f"The sleeper was ended by signal {signal.SIGRTMIN + 5}; starting it again in 0.05 s."]


@pytest.fixture
def impatient(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Look at children often and start them again soon; afterwards signals are handled as before."""
    monkeypatch.setattr(children, "FIRST_PAUSE_S", 0.01)
    monkeypatch.setattr("worker.cli.commands.serve.LOOK_INTERVAL_S", 0.02)
    handlers = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    yield
    for number, handler in handlers.items():
        signal.signal(number, handler)


@pytest.mark.usefixtures("impatient")
def test_an_api_that_never_starts_is_given_up(monkeypatch: pytest.MonkeyPatch, free_port: int):
    monkeypatch.setattr("worker.cli.commands.serve.HEAD_START_S", 0.0)
    others = Child("worker", SLEEPER, os.environ)
    with pytest.raises(CannotServe, match="ended 5 times before it answered"):
        keep({"API": Child("API", FAILING, os.environ), "worker": others}, f"http://127.0.0.1:{free_port}", str)
    assert others.pid is not None
    assert not is_running(others.pid)


@pytest.mark.usefixtures("impatient")
def test_the_api_starts_ahead_of_the_others(monkeypatch: pytest.MonkeyPatch, free_port: int):
    monkeypatch.setattr("worker.cli.commands.serve.HEAD_START_S", 60.0)
    others = Child("worker", SLEEPER, os.environ)
    with pytest.raises(CannotServe):
        keep({"API": Child("API", FAILING, os.environ), "worker": others}, f"http://127.0.0.1:{free_port}", str)
    assert others.pid is None


@pytest.mark.usefixtures("impatient")
def test_whoever_asks_twice_does_not_wait_for_trainings(
    monkeypatch: pytest.MonkeyPatch, free_port: int, tmp_path: Path, told: list[str]
):
    monkeypatch.setattr("worker.cli.commands.serve.END_S", 300.0)
    monkeypatch.setattr("worker.cli.commands.serve.HURRY_S", 0.1)
    monkeypatch.setattr("worker.cli.commands.serve._tell", told.append)
    is_deaf = tmp_path / "is-deaf"
    child = Child("API", ("sh", "-c", f"trap '' TERM; touch {is_deaf}; exec sleep 600"), os.environ)

    def ask_twice() -> None:
        wait_until(is_deaf.exists)
        os.kill(os.getpid(), signal.SIGINT)
        wait_until(lambda: bool(told))
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=ask_twice).start()
    begun = time.monotonic()
    assert keep({"API": child}, f"http://127.0.0.1:{free_port}", str) == 0
    assert time.monotonic() - begun < 200.0
    assert told == ["Trainings may take up to 300 s to checkpoint; Ctrl-C again ends at once."]
    assert child.has_ended


def test_the_service_starts_heals_and_ends_as_one(tmp_path: Path, free_port: int):
    command = [sys.executable, "-m", "worker.cli", "serve", "--port", str(free_port)]
    environment = {**os.environ, "SLDR_HOME": str(tmp_path)}
    environment.pop("SLDR_DATABASE_URL", None)
    address = f"http://127.0.0.1:{free_port}"
    client = httpx.Client(trust_env=False, verify=False, timeout=PATIENCE_S)
    with (
        client,
        (tmp_path / "errors").open("w") as errors,
        subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=errors, text=True) as serving,
    ):
        watchdog = threading.Timer(PATIENCE_S, serving.kill)
        watchdog.start()
        assert serving.stdout is not None
        greeting = serving.stdout.readline()
        assert greeting.startswith(f"SLDR is at {address}/?token="), (tmp_path / "errors").read_text()
        client.get(greeting.split()[3], follow_redirects=True)  # as a person does; the cookie stays with the client
        wait_until(lambda: client.get(f"{address}/healthz").json()["status"] == "ok")

        second = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=PATIENCE_S)
        assert (second.returncode, len(second.stderr.splitlines())) == (2, 1)
        assert f"Cannot listen on 127.0.0.1 port {free_port}" in second.stderr

        [worker] = client.get(f"{address}/api/workers").json()["workers"]
        os.kill(worker["pid"], signal.SIGKILL)
        wait_until(lambda: len(client.get(f"{address}/api/workers").json()["workers"]) == 2)

        family = psutil.Process(serving.pid).children(recursive=True)
        serving.terminate()
        assert serving.wait(PATIENCE_S) == 0
        watchdog.cancel()
    wait_until(lambda: not any(is_running(process.pid) for process in family))
