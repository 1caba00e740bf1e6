"""The supervisor: claims runs for its free slots, keeps one child process for each, and tells the store how they end.

It is deliberately light: what trains is in the children, so that a crash or a hang of one is only a fact to report.
"""

from __future__ import annotations

import logging
import os
import signal
import socket
import time
from dataclasses import dataclass, field
from math import inf

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.errors import StaleFence, StoreUnavailable
from backend.store.outcomes import RETRY_BACKOFF_S, Cancelled, Failed, HandedBack, Outcome, Paused
from backend.store.queue import HEARTBEAT_S, LEASE_S, HeartbeatReply, claim, finish, read_requests, reap_expired
from backend.store.workers import register_worker, retire
from sldr_core.errors import InvalidConfig
from worker.executors.local import LocalChild, LocalExecutor
from worker.heart import Heart
from worker.words import StopWord

log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Timing:
    """Say how often a supervisor looks and how long it waits; tests use shorter times."""

    poll_s: float = 0.5
    """Between two looks at children, requests and queue [s]."""
    heartbeat_s: float = HEARTBEAT_S
    """Between two renewals of the leases [s]."""
    lease_s: float = LEASE_S
    """Without a renewal for this long, a run goes to another worker [s]."""
    reap_s: float = 5.0
    """Between two looks for runs of dead workers [s]."""
    cancel_grace_s: float = 5.0
    """How long a child may take to obey a cancel; then it is killed [s]."""
    stop_grace_s: float = 25.0
    """How long a child may take to end its cycle and checkpoint; then it is killed [s]."""
    retry_backoff_s: float = RETRY_BACKOFF_S
    """Wait before the first retry [s]."""


@dataclass
class _Attempt:
    """One child, and what was asked of it."""

    claim: Claim
    child: LocalChild
    asked: StopWord | None = None
    kill_at: float = field(default=inf)
    """When patience ends, on the monotonic clock [s]."""


class Supervisor:
    """Keep `slots` trainings running as long as there is something to train."""

    def __init__(self, db: Database, executor: LocalExecutor, slots: int, timing: Timing | None = None) -> None:
        if slots < 1:
            raise InvalidConfig({"slots": f"a worker needs at least 1, got {slots}"})
        self._db = db
        self._executor = executor
        self._slots = slots
        self._timing = timing or Timing()
        self._attempts: dict[str, _Attempt] = {}
        self._stops_asked = 0
        self._reap_at = 0.0

    def ask_to_stop(self) -> None:
        """Let every child checkpoint, hand all runs back, then end `run`. Asked again: without checkpoints.

        Safe to call from a signal's function.
        """
        self._stops_asked += 1

    def run(self) -> None:
        """Work until asked to stop. Call it from the main thread."""
        worker_id = register_worker(self._db, socket.gethostname(), os.getpid(), self._slots)
        timing = self._timing
        heart = Heart(self._db, worker_id, self._held, self._lose, timing.heartbeat_s, timing.lease_s)
        heart.start()
        log.info("Worker %s is ready with %d slot(s).", worker_id, self._slots)
        try:
            while self._attempts or not self._stops_asked:
                heart.check()
                self._take_turn(worker_id)
                time.sleep(timing.poll_s)
            retire(self._db, worker_id)
        finally:
            heart.stop()
            for attempt in self._attempts.values():
                attempt.child.kill()
                attempt.child.wait()

    def _take_turn(self, worker_id: str) -> None:
        try:
            self._report_ended()
            self._pass_on_requests()
            self._kill_overdue()
            self._reap()
            if not self._stops_asked:
                self._fill_slots(worker_id)
        except StoreUnavailable as err:
            log.warning("Trying again: %s", err)

    def _held(self) -> list[Claim]:
        return [attempt.claim for attempt in list(self._attempts.values())]

    def _lose(self, claim: Claim) -> None:
        """Let the main loop kill a child whose run went to somebody else. Called by the heart's thread."""
        attempt = self._attempts.get(claim.run_id)
        if attempt is not None and attempt.claim.fence == claim.fence:
            attempt.kill_at = 0.0

    def _fill_slots(self, worker_id: str) -> None:
        while len(self._attempts) < self._slots:
            claimed = claim(self._db, worker_id, self._timing.lease_s)
            if claimed is None:
                return
            self._start(claimed)

    def _start(self, claimed: Claim) -> None:
        try:
            child = self._executor.start(claimed)
        except OSError as err:
            log.exception("Run %s could not be started.", claimed.run_id)
            self._finish(claimed, Failed(f"Its process could not be started: {err}.", retry=True))
            return
        self._attempts[claimed.run_id] = _Attempt(claimed, child)
        log.info("Run %s, attempt %d: started as process %d.", claimed.run_id, claimed.attempt, child.pid)

    def _report_ended(self) -> None:
        for run_id, attempt in list(self._attempts.items()):
            status = attempt.child.poll()
            if status is None:
                continue
            self._finish(attempt.claim, _outcome_of(attempt.asked, status))
            attempt.child.wait()
            del self._attempts[run_id]
            log.info("Run %s, attempt %d: ended with status %d.", run_id, attempt.claim.attempt, status)

    def _finish(self, claimed: Claim, outcome: Outcome) -> None:
        try:
            finish(self._db, claimed, outcome, self._timing.retry_backoff_s)
        except StaleFence:
            log.debug("Run %s: its child has reported already, or it was taken away.", claimed.run_id)

    def _pass_on_requests(self) -> None:
        for attempt in self._attempts.values():
            word = self._wanted_of(read_requests(self._db, attempt.claim))
            if word is not None and attempt.asked not in (word, "cancel"):
                attempt.child.tell(word)
                attempt.asked = word
                grace = self._timing.cancel_grace_s if word == "cancel" else self._timing.stop_grace_s
                attempt.kill_at = min(attempt.kill_at, time.monotonic() + grace)

    def _wanted_of(self, reply: HeartbeatReply) -> StopWord | None:
        if reply.cancel:
            return "cancel"
        if self._stops_asked:
            return "shutdown"
        return "pause" if reply.pause else None

    def _kill_overdue(self) -> None:
        at_once = self._stops_asked > 1
        for attempt in self._attempts.values():
            if at_once or time.monotonic() >= attempt.kill_at:
                log.warning("Run %s: its process %d is killed.", attempt.claim.run_id, attempt.child.pid)
                attempt.child.kill()

    def _reap(self) -> None:
        if time.monotonic() < self._reap_at:
            return
        self._reap_at = time.monotonic() + self._timing.reap_s
        for run_id in reap_expired(self._db, self._timing.retry_backoff_s):
            log.warning("Run %s: its worker gave no sign of life; it was taken from it.", run_id)


def _outcome_of(asked: StopWord | None, status: int) -> Outcome:
    """Say how an attempt ended whose child did not say so itself."""
    match asked:
        case "cancel":
            return Cancelled()
        case "pause":
            return Paused()
        case "shutdown":
            return HandedBack("Its worker was asked to end.")
        case None:
            return Failed(_cause(status), retry=True)


def _cause(status: int) -> str:
    if status >= 0:
        return f"Its process ended early with exit status {status}; the log says more."
    try:
        name = signal.Signals(-status).name
    except ValueError:
        name = f"signal {-status}"
    hint = " (the machine may be out of memory)" if name == "SIGKILL" else ""
    return f"Its process was killed by {name}{hint}."
