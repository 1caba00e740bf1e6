"""The supervisor: claims runs for its free slots, keeps one child process for each, and tells the store how they end.

It is deliberately light: what trains is in the children, so that a crash or a hang of one is only a fact to report.
"""

from __future__ import annotations

import logging
import os
import socket
import time
from dataclasses import dataclass

from backend.logs import about
from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.errors import StaleFence, StoreUnavailable
from backend.store.outcomes import RETRY_BACKOFF_S, Failed, Outcome
from backend.store.queue import HEARTBEAT_S, LEASE_S, HeartbeatReply, claim, finish, read_requests, reap_expired
from backend.store.workers import Machine, register_worker, retire
from sldr_core.errors import InvalidConfig
from worker.attempt import Attempt
from worker.executors import Executor
from worker.heart import Heart
from worker.machine import describe_machine
from worker.patience import insist
from worker.presence import Presence
from worker.words import StopWord

ENDING_S = 2.0
"""How long a child whose attempt is over may take to end by itself [s]."""
HANG_S = 600.0
"""No step of a training takes this long; who shows no progress for so long hangs [s]."""

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
    """How long a child may take to end its cycle and checkpoint when this worker ends; then it is killed [s]."""
    pause_grace_s: float = HANG_S
    """How long a child may take to do that for a pause, which is in no hurry; then it is killed [s]."""
    hang_s: float = HANG_S
    """A child whose training shows no progress for this long is killed and tried again [s]."""
    retry_backoff_s: float = RETRY_BACKOFF_S
    """Wait before the first retry [s]."""


class Supervisor:
    """Keep `slots` trainings running as long as there is something to train."""

    def __init__(
        self,
        db: Database,
        executor: Executor,
        slots: int,
        timing: Timing | None = None,
        machine: Machine | None = None,
    ) -> None:
        """Prepare to work.

        Args:
            slots: trainings at the same time.
            machine: what there is to train with, as it is told to people.
        """
        if slots < 1:
            raise InvalidConfig({"slots": f"a worker needs at least 1, got {slots}"})
        self._db = db
        self._executor = executor
        self._slots = slots
        self._timing = timing or Timing()
        self._machine = machine or describe_machine([])
        self._presence = Presence(self._timing.lease_s)
        if db.engine_name != "sqlite":
            # One that others use over the network may have been away until now, and they had no time to be heard.
            self._presence.note_outage()
        self._attempts: dict[str, Attempt] = {}
        self._stops_asked = 0
        self._reap_at = 0.0
        self._is_cut_off = False

    def ask_to_stop(self) -> None:
        """Let every child checkpoint, hand all runs back, then end `run`. Asked again: without checkpoints.

        Safe to call from a signal's function.
        """
        self._stops_asked += 1

    def run(self) -> None:
        """Work until asked to stop. Call it from the main thread."""
        try:
            worker_id = insist(self._register, is_over=lambda: self._stops_asked > 0)
        except StoreUnavailable as err:
            log.warning("Asked to end before the store knew this worker: %s", err)
            return
        heart = self._make_heart(worker_id)
        heart.start()
        log.info("Worker %s is ready with %d slot(s).", worker_id, self._slots)
        try:
            while self._attempts or not self._stops_asked:
                heart.check()
                self._take_turn(worker_id)
                time.sleep(self._timing.poll_s)
            self._retire(worker_id)
        finally:
            heart.stop()
            for attempt in self._attempts.values():
                attempt.child.kill()
                attempt.child.wait()

    def _register(self) -> str:
        return register_worker(self._db, socket.gethostname(), os.getpid(), self._slots, self._machine)

    def _retire(self, worker_id: str) -> None:
        try:
            retire(self._db, worker_id)
        except StoreUnavailable as err:
            log.warning("The worker stays on the list until it has been silent for long: %s", err)

    def _make_heart(self, worker_id: str) -> Heart:
        timing = self._timing
        return Heart(self._db, worker_id, self._held, self._lose, self._presence, timing.heartbeat_s, timing.lease_s)

    def _take_turn(self, worker_id: str) -> None:
        self._presence.note_turn()
        self._kill_overdue()
        try:
            self._report_ended()
            self._pass_on_requests()
            self._reap()
            if not self._stops_asked:
                self._fill_slots(worker_id)
            self._is_cut_off = False
        except StoreUnavailable as err:
            self._presence.note_outage()
            if not self._is_cut_off:
                log.warning("Trying again and again: %s", err)
                self._is_cut_off = True

    def _held(self) -> list[Claim]:
        return [attempt.claim for attempt in list(self._attempts.values())]

    def _lose(self, claim: Claim) -> None:
        """Let the main loop kill a child whose attempt is over, unless it just ends. Called by the heart's thread."""
        attempt = self._attempts.get(claim.run_id)
        if attempt is not None and attempt.claim.fence == claim.fence:
            attempt.give_up(ENDING_S)

    def _fill_slots(self, worker_id: str) -> None:
        while len(self._attempts) < self._slots and self._executor.has_room():
            claimed = claim(self._db, worker_id, self._timing.lease_s, with_gpu=self._executor.has_gpu())
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
        self._attempts[claimed.run_id] = Attempt(claimed, child)
        with about(run_id=claimed.run_id, attempt=claimed.attempt):
            log.info("Run %s, attempt %d: started as %s.", claimed.run_id, claimed.attempt, child.place)

    def _report_ended(self) -> None:
        for run_id, attempt in list(self._attempts.items()):
            status = attempt.child.poll()
            if status is None:
                continue
            with about(run_id=run_id, attempt=attempt.claim.attempt):
                self._finish(attempt.claim, attempt.outcome())
                attempt.child.wait()
                del self._attempts[run_id]
                log.info("Run %s, attempt %d: ended with status %d.", run_id, attempt.claim.attempt, status)

    def _finish(self, claimed: Claim, outcome: Outcome) -> None:
        try:
            finish(self._db, claimed, outcome, self._timing.retry_backoff_s)
        except StaleFence:
            log.debug("Run %s: its child has reported already, or it was taken away.", claimed.run_id)
        except StoreUnavailable as err:
            if self._stops_asked < 2:
                raise
            log.warning("Run %s: its end could not be told, so its lease will run out: %s", claimed.run_id, err)

    def _pass_on_requests(self) -> None:
        for attempt in self._attempts.values():
            reply = self._read_requests(attempt.claim)
            word = self._wanted_of(reply)
            with about(run_id=attempt.claim.run_id, attempt=attempt.claim.attempt):
                if word is not None:
                    attempt.ask(word, self._grace_for(word))
                if reply.idle_s > self._timing.hang_s and self._presence.is_steady:
                    attempt.give_up_hung(reply.idle_s)

    def _read_requests(self, claimed: Claim) -> HeartbeatReply:
        """Ask what people want of an attempt; a store that cannot answer must not keep a worker from ending."""
        try:
            return read_requests(self._db, claimed)
        except StoreUnavailable:
            if not self._stops_asked:
                raise
            return HeartbeatReply(alive=True, cancel=False, pause=False)

    def _wanted_of(self, reply: HeartbeatReply) -> StopWord | None:
        if reply.cancel:
            return "cancel"
        if self._stops_asked:
            return "shutdown"
        return "pause" if reply.pause else None

    def _grace_for(self, word: StopWord) -> float:
        timing = self._timing
        return {"cancel": timing.cancel_grace_s, "shutdown": timing.stop_grace_s, "pause": timing.pause_grace_s}[word]

    def _kill_overdue(self) -> None:
        for attempt in self._attempts.values():
            attempt.kill_if_overdue(at_once=self._stops_asked > 1)

    def _reap(self) -> None:
        if time.monotonic() < self._reap_at or not self._presence.is_steady:
            return
        self._reap_at = time.monotonic() + self._timing.reap_s
        for run_id in reap_expired(self._db, self._timing.retry_backoff_s):
            with about(run_id=run_id):
                log.warning("Run %s: its worker gave no sign of life; it was taken from it.", run_id)
