"""What session processes of the tests run; importable, because each is a fresh interpreter."""

from __future__ import annotations

import os
import signal
import time
from multiprocessing.connection import Connection

from worker.viewer.reports import Job, Ready, Watched


def serve_nothing(job: Job, host: Connection) -> None:
    host.send(Ready(1234, "Nothing."))
    time.sleep(60)


def serve_one_client(job: Job, host: Connection) -> None:
    host.send(Ready(1234, "Nothing."))
    host.send(Watched(1))
    time.sleep(60)


def serve_a_client_who_leaves(job: Job, host: Connection) -> None:
    host.send(Ready(1234, "Nothing."))
    host.send(Watched(1))
    host.send(Watched(0))
    time.sleep(60)


def die_at_once(job: Job, host: Connection) -> None:
    os.kill(os.getpid(), signal.SIGKILL)
