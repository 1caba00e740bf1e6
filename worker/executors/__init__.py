"""Where attempts run: what a supervisor asks of an executor, and of the children that it starts."""

from __future__ import annotations

from typing import Protocol

from backend.store.claims import Claim
from backend.store.outcomes import Outcome


class Child(Protocol):
    """The process of one attempt, wherever it runs. Only `wait` waits."""

    @property
    def place(self) -> str:
        """Where it runs, in words for the log."""
        ...

    def tell(self, message: str) -> None:
        """Pass it one line; one that no longer listens is left alone."""
        ...

    def poll(self) -> int | None:
        """Return its exit status (a negative signal number if it was killed), or None while it may still run."""
        ...

    def outcome(self) -> Outcome:
        """Say how the attempt ended, as far as its process' end tells. Ask only once `poll` has returned a status."""
        ...

    def kill(self) -> None:
        """End it and everything that it started, at once. Asked again, it does nothing more."""
        ...

    def wait(self) -> int:
        """Wait until it has ended, let go of it, and return its exit status."""
        ...


class Executor(Protocol):
    """Start attempts on this machine or on others."""

    def has_room(self) -> bool:
        """Tell whether another attempt could start now; a supervisor claims nothing while there is none."""
        ...

    def has_gpu(self) -> bool:
        """Tell whether there is a GPU, used or not, for runs that ask for one; on a cluster one may join any time."""
        ...

    def start(self, claim: Claim) -> Child:
        """Start an attempt; what its process prints goes to the log in the run's directory.

        Call it from the main thread only: a child ends with the thread that started it.

        Raises:
            OSError: it cannot be started on this machine.
        """
        ...
