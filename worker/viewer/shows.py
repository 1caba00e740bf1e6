"""The kinds of 3D views: to add one, write its show and add a line here and one in `session_files.py`.

Each is imported when it is opened: some need PyTorch, others do not.
"""

from __future__ import annotations

from collections.abc import Callable

import viser

from sldr_core.errors import UnknownName
from worker.viewer.reports import Job
from worker.viewer.show import Show

Opener = Callable[[viser.ViserServer, Job], Show]
"""Open a view on a page.

Raises:
    SldrError: what it needs cannot be used; the text says why.
"""


def _live(server: viser.ViserServer, job: Job) -> Show:
    from worker.viewer.live import open_live

    return open_live(server, job)


def _inspector(server: viser.ViserServer, job: Job) -> Show:
    from worker.viewer.inspector.show import open_inspector

    return open_inspector(server, job)


def _episode(server: viser.ViserServer, job: Job) -> Show:
    from worker.viewer.episode import open_episode

    return open_episode(server, job)


def _time_machine(server: viser.ViserServer, job: Job) -> Show:
    from worker.viewer.time_machine import open_time_machine

    return open_time_machine(server, job)


SHOWS: dict[str, Opener] = {
    "live": _live,
    "episode": _episode,
    "time-machine": _time_machine,
    "inspector": _inspector,
}
"""How each kind of request is shown."""


def open_show(server: viser.ViserServer, job: Job) -> Show:
    """Open the view that a job asks for.

    Raises:
        UnknownName: there is no such kind of view.
        SldrError: what it needs cannot be used.
    """
    kind = str(job.request.get("kind"))
    if kind not in SHOWS:
        raise UnknownName("kind of 3D view", kind, SHOWS)
    return SHOWS[kind](server, job)
