"""The process that hosts sessions: what it starts beside them, and how it tells of their ends."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest
from other_processes import wait_until

from backend.store.settings import Settings
from worker.exit_words import describe_exit
from worker.viewer import __main__ as process

PICTURES_S = 60.0
"""How long the process that draws pictures may take to be taken off the list [s]."""


class Idle:
    """Stand in for a host that has nothing to do."""

    def __init__(self, *_: object, **__: object) -> None: ...

    def begin(self) -> None: ...

    def tick(self) -> None: ...

    def close(self) -> None: ...


@pytest.fixture
def handlers() -> Iterator[None]:
    """Handle signals afterwards as before."""
    kept = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    yield
    for number, handler in kept.items():
        signal.signal(number, handler)


@pytest.mark.usefixtures("handlers")
def test_the_process_that_draws_pictures_leaves_no_zombie(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    started: list[subprocess.Popen[bytes]] = []

    def draw(_: Path) -> subprocess.Popen[bytes]:
        started.append(subprocess.Popen([sys.executable, "-c", ""]))
        return started[0]

    def watch() -> None:
        try:
            wait_until(lambda: bool(started) and not psutil.pid_exists(started[0].pid), PICTURES_S)
            gone.set()
        finally:
            signal.raise_signal(signal.SIGTERM)

    gone = threading.Event()
    monkeypatch.setattr(process, "Host", Idle)
    monkeypatch.setattr(process, "MediaHost", Idle)
    monkeypatch.setattr(process, "keep_warm", threading.Event)
    monkeypatch.setattr(process, "open_database", lambda _: Idle())
    monkeypatch.setattr(process, "_draw_pictures", draw)
    threading.Thread(target=watch).start()
    process.host_sessions(Settings(tmp_path, "sqlite://"))

    assert gone.is_set()


@pytest.mark.parametrize(
    ("exit_code", "sentence"),
    [(1, "ended with exit code 1"), (-9, "was ended by SIGKILL"), (-40, "was ended by signal 40")],
)
def test_an_end_is_told_in_words(exit_code: int, sentence: str) -> None:
    assert describe_exit(exit_code) == sentence
