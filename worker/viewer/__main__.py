"""`python -m worker.viewer`: host 3D sessions; with `--policy FILE`, show one policy and nothing else."""

from __future__ import annotations

import argparse
import logging
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path

from backend.logs import load_style, start_logging
from backend.store.database import open_database
from backend.store.errors import StoreUnavailable
from backend.store.settings import Settings, load_settings
from sldr_core.errors import InvalidConfig
from worker.media.host import MediaHost
from worker.ports import HIGHEST_PORT
from worker.sentences import tell
from worker.viewer.host import Host
from worker.viewer.process import serve_session
from worker.viewer.warming import keep_warm

POLL_S = 0.2
"""Time between two looks into the store [s]."""

STORE_RETRY_S = 2.0
"""Time to wait after the store could not be used [s]."""

log = logging.getLogger("sldr.viewer")


def main() -> int:
    """Host sessions until SIGTERM or Ctrl-C; what the user can put right is told in one sentence."""
    parser = argparse.ArgumentParser(prog="python -m worker.viewer", description=__doc__)
    parser.add_argument("--policy", type=Path, metavar="FILE", help="show this policy, without the service")
    parser.add_argument("--port", type=int, default=0, help="port for --policy (0: a free one)")
    options = parser.parse_args()
    settings = load_settings()
    try:
        if not 0 <= options.port <= HIGHEST_PORT:
            raise InvalidConfig({"port": f"it must be between 0 and {HIGHEST_PORT}, got {options.port}"})
        start_logging("viewer", settings.logs_directory, load_style())
        if options.policy is not None:
            _show_one(options.policy, options.port)
        else:
            host_sessions(settings)
    except KeyboardInterrupt:
        return 0
    except Exception as err:
        return tell(err)
    return 0


def host_sessions(settings: Settings) -> None:
    """Serve sessions until SIGTERM or SIGINT."""
    stop = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stop.set())
    database = open_database(settings)
    host = Host(database, settings, target=serve_session, is_warm=keep_warm().is_set)
    host.begin()
    media = MediaHost(database, settings)
    pictures = _draw_pictures(settings.home)
    try:
        while not stop.is_set():
            # The last is for a process that has ended to be taken off the list of processes.
            stop.wait(_round(host.tick, media.tick, pictures.poll))
    finally:
        pictures.terminate()
        host.close()
        media.close()
        pictures.wait()
        database.close()


def _round(*ticks: Callable[[], object]) -> float:
    """Do one round of everything, and return how long to wait for the next [s]."""
    try:
        for tick in ticks:
            tick()
    except StoreUnavailable as err:
        log.warning("%s Trying again.", err)
        return STORE_RETRY_S
    return POLL_S


def _draw_pictures(home: Path) -> subprocess.Popen[bytes]:
    """Draw the missing pictures of the tasks beside everything else; what goes wrong is on this process's stderr."""
    return subprocess.Popen([sys.executable, "-m", "worker.render", "--all-below", str(home)])


def _show_one(policy: Path, port: int) -> None:
    from worker.viewer.panel import add_panel
    from worker.viewer.reports import Job
    from worker.viewer.session import open_session, watch

    session = open_session(Job("alone", {"kind": "live"}, {"policy": (policy,)}), port, is_alone=True)
    add_panel(session.server, session.control.ask)
    print(f"{session.show.message} http://127.0.0.1:{session.port}/", flush=True)
    watch(session)


if __name__ == "__main__":
    sys.exit(main())
