"""One attempt as its supervisor sees it: the child that trains, what was asked of it, and how it ended."""

from __future__ import annotations

import logging
import time
from math import inf

from backend.store.claims import Claim
from backend.store.outcomes import Cancelled, Failed, HandedBack, Outcome, Paused
from worker.executors import Child
from worker.words import StopWord

log = logging.getLogger(__name__)


class Attempt:
    """Hold one child, and answer for it when it cannot answer for itself."""

    def __init__(self, claim: Claim, child: Child) -> None:
        self.claim = claim
        self.child = child
        self._asked: StopWord | None = None
        self._kill_at = inf
        self._hung: str | None = None
        self._is_killed = False

    def ask(self, word: StopWord, grace_s: float) -> None:
        """Ask the child to end; kill it if it has not after so long [s]. A cancel is never taken back."""
        if self._asked in (word, "cancel"):
            return
        self.child.tell(word)
        self._asked = word
        self._kill_at = min(self._kill_at, time.monotonic() + grace_s)

    def give_up(self, grace_s: float = 0.0) -> None:
        """Let the child be killed unless it ends by itself within so long [s]. May be called from any thread."""
        self._kill_at = min(self._kill_at, time.monotonic() + grace_s)

    def give_up_hung(self, idle_s: float) -> None:
        """Let the child be killed because it has shown no progress for so long [s]."""
        if self._hung is None:
            self._hung = f"It showed no progress for {in_words(idle_s)} and was ended; it goes on from its checkpoint."
            log.warning("Run %s: %s", self.claim.run_id, self._hung)
        self.give_up()

    def kill_if_overdue(self, at_once: bool) -> None:
        """Kill the child if its time is up.

        Args:
            at_once: whether it is up in any case.
        """
        if not at_once and time.monotonic() < self._kill_at:
            return
        if not self._is_killed:
            log.warning("Run %s: its %s is killed.", self.claim.run_id, self.child.place)
        self._is_killed = True
        self.child.kill()

    def outcome(self) -> Outcome:
        """Say how it ended, if the child did not say so itself. Ask only once the child has ended."""
        match self._asked:
            case "cancel":
                return Cancelled()
            case _ if self._hung is not None:
                return Failed(self._hung, retry=True)
            case "pause":
                return Paused()
            case "shutdown":
                return HandedBack("Its worker was asked to end.")
            case None:
                return self.child.outcome()


def in_words(seconds: float) -> str:
    """Put a time into words for a person."""
    return f"{seconds / 60.0:.0f} minutes" if seconds >= 120.0 else f"{seconds:.0f} seconds"
