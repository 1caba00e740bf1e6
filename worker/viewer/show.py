"""What a kind of 3D view is: something that draws itself as time passes and obeys commands of its own."""

from __future__ import annotations

from typing import Any, Protocol

from worker.viewer.commands import Command
from worker.viewer.transport import Transport


class Show(Protocol):
    """One kind of view, open in one scene. It is used from one thread only.

    It is made by its function in `worker.viewer.shows`, which is given the page's server and the job.
    """

    @property
    def message(self) -> str:
        """What is shown, in one sentence."""
        ...

    @property
    def transport(self) -> Transport:
        """The clock; the session obeys its commands."""
        ...

    def advance(self, wall_s: float) -> None:
        """Let time pass on the wall, compute what is due, and draw it."""
        ...

    def obey(self, command: Command) -> dict[str, Any] | None:
        """Do what a command of this kind says; return what it asks for, if it asks.

        Raises:
            BadCommand: there is no such command, or a value of it makes no sense.
        """
        ...

    def state(self) -> dict[str, Any]:
        """Return what the page shows of this kind besides the transport; small, it is told with every frame."""
        ...

    def report(self) -> dict[str, Any]:
        """Return the moment that is drawn, exactly: at least its `qpos`."""
        ...
