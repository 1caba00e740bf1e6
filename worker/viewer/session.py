"""One 3D session in its own process: a page, a control channel, and the show that both belong to."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any

import viser

from sldr_core.errors import SldrError
from worker.viewer import transport
from worker.viewer.commands import read_command
from worker.viewer.control import Asked, ControlChannel
from worker.viewer.page import open_page
from worker.viewer.reports import Job, Ready, Watched
from worker.viewer.show import Show
from worker.viewer.shows import open_show

FRAME_S = 1.0 / 30.0
"""Time between two frames [s]."""

STATE_S = 1.0 / 15.0
"""Time between two states that tell only that time has passed [s]; what a page asks for is told at once."""

UNWATCHED_S = 0.2
"""Time between two looks for a client while nobody watches; nothing is simulated then [s]."""

log = logging.getLogger("sldr.viewer")


@dataclass(frozen=True)
class Session:
    """Hold an open view with its two doors."""

    server: viser.ViserServer
    control: ControlChannel
    show: Show

    @property
    def port(self) -> int:
        """Where the page is served on 127.0.0.1."""
        return self.server.get_port()

    @property
    def watchers(self) -> int:
        """People who look at it now."""
        return max(len(self.server.get_clients()), self.control.pages)

    def state(self) -> dict[str, Any]:
        """Return what the page is told with every frame."""
        return {**self.show.transport.state(), **self.show.state()}

    def answer(self, asked: Asked) -> None:
        """Do what a page asked for, and tell it what came of it."""
        reply: dict[str, Any] = {}
        try:
            command = read_command(asked.text)
            reply["id"] = command.id
            if command.do in transport.VERBS:
                self.show.transport.obey(command)
                answer = None
            elif command.do == "report":
                # What was asked before is drawn first: the report is of what stands on the page.
                self.show.advance(0.0)
                answer = {**self.state(), **self.show.report()}
            else:
                answer = self.show.obey(command)
        except SldrError as err:
            asked.answer({**reply, "error": str(err)})
            return
        if answer is not None or reply["id"] is not None:
            asked.answer({**reply, "answer": answer or {}})


def open_session(job: Job, port: int = 0, is_alone: bool = False) -> Session:
    """Open the view that a job asks for.

    Args:
        job: what to show.
        port: where its page is served (0: a free one).
        is_alone: whether browsers open the page there, and not through the proxy.

    Raises:
        SldrError: what it needs cannot be used.
    """
    server = open_page(port, is_alone)
    show = open_show(server, job)
    show.advance(0.0)
    control = ControlChannel()
    session = Session(server, control, show)
    control.publish(session.state())
    return session


def serve(job: Job, host: Connection, watched: Callable[[], None]) -> None:
    """Open a session, tell the host, and run it for ever; call `watched` whenever a page has been loaded.

    Raises:
        SldrError: what it needs cannot be used.
        BrokenPipeError: the host is gone.
    """
    session = open_session(job)
    host.send(Ready(session.port, session.show.message, session.control.port))

    def tell(clients: int) -> None:
        host.send(Watched(clients))
        if clients > 0:
            watched()

    watch(session, tell)


def watch(session: Session, tell: Callable[[int], None] = lambda clients: None) -> None:
    """Run a session for ever; tell each time the number of people who watch has changed."""
    clients, last, due, tell_due = -1, time.monotonic(), 0.0, 0.0
    while True:
        frame_s = FRAME_S if clients > 0 else UNWATCHED_S
        asked = session.control.take(max(due - time.monotonic(), 0.0))
        for each in asked:
            session.answer(each)
        now = time.monotonic()
        if now >= due:
            due = max(due + frame_s, now)
        if session.watchers != clients:
            clients = session.watchers
            tell(clients)
        if clients > 0:
            session.show.advance(now - last)
            if asked or now >= tell_due:
                tell_due = max(tell_due + STATE_S, now)
                session.control.publish(session.state())
        last = now
