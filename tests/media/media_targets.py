"""What drawing processes of the tests run; importable, because each is a fresh interpreter."""

from __future__ import annotations

import os
import signal
import time
from multiprocessing.connection import Connection

from sldr_core.disk import temporary_beside
from worker.media.orders import Drawn, DrawOrder, NotDrawn

CONTENT = b"a picture"


def write_words(host: Connection, host_pid: int) -> None:
    """Write a few bytes instead of a picture."""
    while True:
        order: DrawOrder = host.recv()
        order.target.parent.mkdir(parents=True, exist_ok=True)
        order.target.write_bytes(CONTENT)
        host.send(Drawn(len(CONTENT), "c" * 64))


def die_of_it(host: Connection, host_pid: int) -> None:
    """End without a word, as a driver that crashes does."""
    host.recv()
    os.kill(os.getpid(), signal.SIGKILL)


def die_while_drawing(host: Connection, host_pid: int) -> None:
    """Be killed in the middle of a file."""
    order: DrawOrder = host.recv()
    order.target.parent.mkdir(parents=True, exist_ok=True)
    temporary_beside(order.target).write_bytes(CONTENT)
    os.kill(os.getpid(), signal.SIGKILL)


def see_nothing(host: Connection, host_pid: int) -> None:
    """Be a machine without EGL."""
    host.recv()
    host.send(NotDrawn("MuJoCo cannot draw off screen here.", is_machine=True))
    time.sleep(60.0)


def see_from_the_second_time_on(host: Connection, host_pid: int) -> None:
    """Be a machine that gets EGL while its host works."""
    order: DrawOrder = host.recv()
    mark = order.target.with_name("has-egl")
    if mark.exists():
        order.target.write_bytes(CONTENT)
        host.send(Drawn(len(CONTENT), "c" * 64))
    else:
        mark.touch()
        host.send(NotDrawn("MuJoCo cannot draw off screen here.", is_machine=True))
    time.sleep(60.0)


def never_answer(host: Connection, host_pid: int) -> None:
    """Hang, as a renderer does that waits for its driver."""
    time.sleep(60.0)
