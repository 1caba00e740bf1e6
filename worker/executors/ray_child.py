"""One attempt somewhere on a Ray cluster, seen from its supervisor: asked without waiting, and given up when lost."""

from __future__ import annotations

import logging
import signal
import time
from typing import Any

import ray
from ray.exceptions import ActorDiedError, ActorUnavailableError, RayError, RayTaskError

from backend.store.outcomes import Failed, HandedBack, Lost, Outcome
from worker.executors.attempt_host import NodeUnfit, Placement
from worker.executors.endings import failure_of
from worker.executors.ray_needs import Needs

PLACEMENT_S = 60.0
"""How long Ray may look for a node with enough free cores; others may have been faster [s]."""
PLACE_AGAIN_S = 60.0
"""How long a run stays in the queue that found no node fit for it [s]."""
SETTLING_S = 2.0
"""How long after a start the cluster's count of free cores may still be the old one [s]."""
KILL_S = 5.0
"""How long a node may take to kill an attempt; then what holds it there is killed [s]."""
WAIT_STEP_S = 0.05
NODE_DIED = "its node has died"
"""What Ray writes of an attempt whose machine is gone, and of no other."""

EXIT_LOST = 72
"""Stands for the exit status of a process that nobody can ask any more."""
EXIT_UNPLACED = 73
"""Stands for the exit status of a process that was never started."""

log = logging.getLogger(__name__)


class RayChild:
    """Hold one attempt on a node, or on its way there."""

    def __init__(self, host: Any, starting: ray.ObjectRef, needs: Needs, run_id: str) -> None:
        """Follow an attempt.

        Args:
            host: the handle of its `AttemptHost`.
            starting: what its `start` will return.
            needs: what it waits for.
        """
        self._host = host
        self._starting = starting
        self._needs = needs
        self._run_id = run_id
        self._give_up_at = time.monotonic() + PLACEMENT_S
        self._kill_at: float | None = None
        self._placement: Placement | None = None
        self._placed_at = 0.0
        self._looking: ray.ObjectRef[int | None] | None = None
        self._status: int | None = None
        self._outcome: Outcome | None = None

    @property
    def place(self) -> str:
        """Its process and machine, in words."""
        if self._placement is None:
            return f"process on the node that Ray finds for {self._needs}"
        return f"process {self._placement.pid} on {self._placement.host}"

    def is_settled(self) -> bool:
        """Tell whether what it takes is taken off what the cluster says is free."""
        self.poll()
        return self._status is not None or (
            self._placement is not None and time.monotonic() > self._placed_at + SETTLING_S
        )

    def tell(self, message: str) -> None:
        """Send it one line; it arrives after its start, in order."""
        if self._status is None:
            self._host.tell.remote(message)

    def poll(self) -> int | None:
        """Return its exit status, or None while it may still run."""
        if self._status is None:
            try:
                self._look()
            except RayTaskError as err:
                self._end(EXIT_UNPLACED, _outcome_of(err))
            except ActorUnavailableError as err:
                self._wait_or_give_up(err)
            except RayError as err:
                self._give_up(err)
        return self._status

    def outcome(self) -> Outcome:
        """Say how the attempt ended."""
        assert self._outcome is not None, "ask only once `poll` has returned a status"
        return self._outcome

    def kill(self) -> None:
        """Have its node kill it; a node that does not answer loses what holds the attempt."""
        if self._status is not None or self._kill_at is not None:
            return
        self._kill_at = time.monotonic() + KILL_S
        if self._placement is None:
            self._end(-signal.SIGKILL, failure_of(-signal.SIGKILL))
        else:
            self._host.kill.remote()

    def wait(self) -> int:
        """Wait until it has ended and let go of its node."""
        while (status := self.poll()) is None:
            time.sleep(WAIT_STEP_S)
        return status

    def _look(self) -> None:
        """Ask, and take the answer to what was asked before if it is there."""
        if self._placement is None:
            self._look_for_place()
            return
        if self._kill_at is not None and time.monotonic() > self._kill_at:
            self._end(-signal.SIGKILL, failure_of(-signal.SIGKILL))
            return
        looking: ray.ObjectRef[int | None] = self._looking or self._host.poll.remote()
        self._looking = looking
        if _is_ready(looking):
            status = ray.get(looking)
            self._looking = None
            if status is not None:
                self._end(status, failure_of(status))

    def _look_for_place(self) -> None:
        if _is_ready(self._starting):
            self._placement = ray.get(self._starting)
            self._placed_at = time.monotonic()
            log.info("Run %s: it is %s.", self._run_id, self.place)
        elif time.monotonic() > self._give_up_at:
            reason = f"For {PLACEMENT_S:.0f} s no node of the cluster had {self._needs} free, or none could start it."
            self._end(EXIT_UNPLACED, HandedBack(reason, PLACE_AGAIN_S))

    def _wait_or_give_up(self, err: ActorUnavailableError) -> None:
        """Ask again later, for the way there is disturbed and Ray finds out whether it is gone."""
        if self._placement is None:
            self._give_up(err)  # Its start is asked for once: no other answer will come.
        else:
            self._looking = None

    def _give_up(self, err: RayError) -> None:
        if self._kill_at is not None:
            self._end(-signal.SIGKILL, failure_of(-signal.SIGKILL))
            return
        where = f"on {self._placement.host}" if self._placement else "before it was placed"
        log.warning("Run %s: lost %s: %s", self._run_id, where, " ".join(str(err).split()))
        self._end(EXIT_LOST, Lost(f"{_loss(err)} {where}."))

    def _end(self, status: int, outcome: Outcome) -> None:
        """Keep how it ended, and give its cores back to the cluster."""
        self._status, self._outcome = status, outcome
        ray.kill(self._host, no_restart=True)


class UnplacedChild:
    """Stand for an attempt that no node can run."""

    place = "no process"

    def __init__(self, reason: str) -> None:
        self._reason = reason

    def tell(self, message: str) -> None:
        """Pass nothing on."""

    def poll(self) -> int:
        """Return that it was never started."""
        return EXIT_UNPLACED

    def outcome(self) -> Outcome:
        """Hand the run back, for later."""
        return HandedBack(self._reason, PLACE_AGAIN_S)

    def kill(self) -> None:
        """Do nothing: there is nothing."""

    def wait(self) -> int:
        """Return that it was never started."""
        return EXIT_UNPLACED


def _is_ready(reference: ray.ObjectRef) -> bool:
    ready, _ = ray.wait([reference], timeout=0)
    return bool(ready)


def _outcome_of(err: RayTaskError) -> Outcome:
    """Say what an error on the node means."""
    cause = err.cause
    if isinstance(cause, NodeUnfit):
        return HandedBack(str(cause), PLACE_AGAIN_S)
    return Failed(f"Its process could not be started: {cause}.", retry=True)


def _loss(err: RayError) -> str:
    """Say in words what is gone."""
    if isinstance(err, ActorDiedError) and NODE_DIED in str(err):
        return "The cluster lost its node"
    return "The cluster lost what held its process"
