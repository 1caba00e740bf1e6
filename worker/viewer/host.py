"""The viewer host: takes the 3D sessions that are asked for and serves each in a process of its own.

The processes are forked from one that has imported everything before (`worker.viewer.warming`).
"""

from __future__ import annotations

import logging
import multiprocessing
import os
import socket
import time
import uuid
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from multiprocessing.context import ForkServerProcess

import psutil

from backend.store import viewer_sessions
from backend.store.database import Database
from backend.store.errors import FilesUnavailable
from backend.store.settings import Settings
from backend.store.storage import FileStorage
from sldr_core.errors import SldrError
from worker.exit_words import describe_exit
from worker.sentences import unreadable
from worker.viewer.reports import Broken, Job, Ready, Report, Watched
from worker.viewer.session_files import Files, RunFiles, find_session_files

ENDING_S = 3.0
"""A session process that was asked to end and has not by then is killed [s]."""

ORPHANED = "The 3D viewer was started again; open the view once more."
"""What a session says whose host is no more."""

Target = Callable[[Job, Connection], None]
"""What a session process runs."""

log = logging.getLogger("sldr.viewer")


@dataclass(frozen=True)
class Limits:
    """Say how long and how many."""

    sessions: int = 8
    """Sessions at once on one host."""
    idle_s: float = 60.0
    """A session that somebody watched ends this long after the last one left [s]."""
    unopened_s: float = 120.0
    """A session that nobody opened ends after this [s]."""
    beat_s: float = 5.0
    """Time between two signs of life, of the host and of watched sessions [s]."""


@dataclass(frozen=True)
class Ending:
    """Say why a session is over."""

    message: str
    failed: bool


@dataclass
class Served:
    """Follow one session and its process."""

    session: viewer_sessions.Session
    process: ForkServerProcess
    pipe: Connection
    idle_since: float
    """When the last client left, or when it was started [s, monotonic]."""
    clients: int = 0
    was_watched: bool = False
    broken: str | None = None
    """Why it cannot go on, if it said so."""
    ready: Ready | None = None
    """That its page can be opened, until the store knows."""
    ending: Ending | None = None
    """Why its process was ended, until the store knows."""


@dataclass
class Host:
    """Serve sessions; `tick` does one round of everything."""

    database: Database
    settings: Settings
    target: Target
    limits: Limits = field(default_factory=Limits)
    is_warm: Callable[[], bool] = lambda: True
    """Whether sessions can be started without waiting."""
    host_id: str = field(default_factory=lambda: uuid.uuid4().hex[:12])
    served: dict[str, Served] = field(default_factory=dict)
    _beat_at: float = field(default=-1e9, init=False)
    _files: RunFiles = field(init=False)

    def __post_init__(self) -> None:
        """Make ready to find what sessions show."""
        self._files = RunFiles(self.database, self.settings, FileStorage(self.settings))

    def begin(self) -> None:
        """Announce the host, and end what dead ones left open."""
        self._beat(time.monotonic())

    def tick(self) -> None:
        """Hear the sessions, end those that are over, start those that are asked for.

        Raises:
            StoreUnavailable: the store cannot be used just now; the next round tells it what it could not be told.
        """
        now = time.monotonic()
        for served in list(self.served.values()):
            if served.ending is None:
                self._hear(served, now)
                self._end_if_over(served, now)
            else:
                self._forget(served, served.ending)
        open_sessions = viewer_sessions.list_open(self.database)
        self._end_closed({session.id for session in open_sessions})
        if self.is_warm():
            self._serve_next(open_sessions, now)
        if now - self._beat_at >= self.limits.beat_s:
            self._beat(now)

    def close(self) -> None:
        """End every session and its process.

        Raises:
            StoreUnavailable: the store cannot be used just now; the next host ends what stays open in it.
        """
        endings = [(served, _stop(served, "The 3D viewer was stopped.")) for served in self.served.values()]
        for served, ending in endings:
            self._forget(served, ending)

    def _serve_next(self, open_sessions: Sequence[viewer_sessions.Session], now: float) -> None:
        session = self._next(open_sessions)
        if session is None:
            return
        try:
            files = find_session_files(self._files, session)
        except (SldrError, FilesUnavailable) as err:
            self._refuse(session, str(err))
            return
        except OSError as err:
            self._refuse(session, unreadable(err))
            return
        if not self._make_room():
            watched = f"All {self.limits.sessions} 3D views of this machine are being watched"
            self._refuse(session, f"{watched}; close one and try again.")
        else:
            self.served[session.id] = self._start(session, files, now)

    def _refuse(self, session: viewer_sessions.Session, message: str) -> None:
        viewer_sessions.mark_ended(self.database, session.id, failed=True, message=message)

    def _next(self, open_sessions: Sequence[viewer_sessions.Session]) -> viewer_sessions.Session | None:
        """Return a session that was taken and could not be served when the store went away, or take another."""
        for session in open_sessions:
            if session.host_id == self.host_id and session.id not in self.served:
                return session
        if any(session.host_id is None for session in open_sessions):
            return viewer_sessions.next_requested(self.database, self.host_id)
        return None

    def _start(self, session: viewer_sessions.Session, files: Files, now: float) -> Served:
        context = multiprocessing.get_context("forkserver")
        ours, theirs = context.Pipe()
        job = Job(session.id, session.request, files)
        process = context.Process(target=self.target, args=(job, theirs), name=f"viewer-session-{session.id}")
        process.start()
        theirs.close()
        log.info("session %s of %s started as process %s", session.id, session.run_id, process.pid)
        return Served(session, process, ours, idle_since=now)

    def _make_room(self) -> bool:
        """End the session that nobody has watched for longest if there is no room, and tell whether there is now."""
        if len(self.served) < self.limits.sessions:
            return True
        idle = [served for served in self.served.values() if served.clients == 0]
        if not idle:
            return False
        self._end(min(idle, key=lambda served: served.idle_since), "It made room for a newer 3D view.")
        return True

    def _hear(self, served: Served, now: float) -> None:
        try:
            while served.pipe.poll():
                self._take_report(served, served.pipe.recv(), now)
        except (EOFError, ConnectionResetError):
            # The process is gone or going; `_end_if_over` says why.
            served.process.join(ENDING_S)
        if served.ready is not None:
            told = served.ready
            viewer_sessions.mark_ready(self.database, served.session.id, told.port, told.message, told.control_port)
            served.ready = None

    def _take_report(self, served: Served, report: Report, now: float) -> None:
        match report:
            case Ready():
                served.ready = report
                served.idle_since = now  # nobody could look at it before
            case Watched(clients):
                if served.clients or clients:
                    served.idle_since = now
                served.clients = clients
                served.was_watched = served.was_watched or clients > 0
            case Broken(message):
                served.broken = message

    def _end_if_over(self, served: Served, now: float) -> None:
        patience = self.limits.idle_s if served.was_watched else self.limits.unopened_s
        if served.broken is not None:
            self._end(served, served.broken, failed=True)
        elif not served.process.is_alive():
            self._end(served, f"The 3D view {describe_exit(served.process.exitcode)}; open it again.", failed=True)
        elif served.clients == 0 and now - served.idle_since > patience:
            self._end(served, f"Nobody watched for {patience:.0f} s.")

    def _end_closed(self, open_ids: set[str]) -> None:
        for session_id in [session_id for session_id in self.served if session_id not in open_ids]:
            self._end(self.served[session_id], "It was closed.")

    def _end(self, served: Served, message: str, failed: bool = False) -> None:
        self._forget(served, _stop(served, message, failed))

    def _forget(self, served: Served, ending: Ending) -> None:
        """Forget a session whose process was ended, once the store knows."""
        viewer_sessions.mark_ended(self.database, served.session.id, ending.failed, ending.message)
        log.info("session %s ended: %s", served.session.id, ending.message)
        del self.served[served.session.id]

    def _beat(self, now: float) -> None:
        self._beat_at = now
        machine = socket.gethostname()
        viewer_sessions.beat_host(self.database, self.host_id, os.getpid(), machine)
        viewer_sessions.end_orphaned_sessions(self.database, self.host_id, machine, _is_another_process, ORPHANED)
        for served in self.served.values():
            if served.clients:
                viewer_sessions.touch(self.database, served.session.id)
                self._renew_files(served.session)

    def _renew_files(self, session: viewer_sessions.Session) -> None:
        """Bring followed policies again if there is a shared place; where there is none, they are followed at home."""
        if self._files.storage.shared is None:
            return
        try:
            find_session_files(self._files, session)
        except (SldrError, FilesUnavailable, OSError) as err:
            log.warning("session %s goes on with what it has: %s", session.id, err)


def _stop(served: Served, message: str, failed: bool = False) -> Ending:
    """End the process of a session, unless that was done before; return why."""
    if served.ending is None:
        served.ending = Ending(message, failed)
        served.process.terminate()
        served.process.join(ENDING_S)
        if served.process.is_alive():
            served.process.kill()
            served.process.join()
        served.process.close()
        served.pipe.close()
    return served.ending


def _is_another_process(pid: int) -> bool:
    """Tell whether a process of this machine lives and is not this one, which may have inherited the number."""
    return pid != os.getpid() and psutil.pid_exists(pid)
