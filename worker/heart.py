"""The heartbeat of a worker: a thread that renews its leases, however busy trainings and main loop are."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Sequence

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.errors import StoreUnavailable
from backend.store.queue import heartbeat
from backend.store.workers import beat
from worker.machine import memory_used
from worker.presence import Presence

log = logging.getLogger(__name__)


class Heart:
    """Beat for a worker and for every attempt that it holds."""

    def __init__(
        self,
        db: Database,
        worker_id: str,
        held: Callable[[], Sequence[Claim]],
        on_lost: Callable[[Claim], None],
        presence: Presence,
        interval_s: float,
        lease_s: float,
    ) -> None:
        self._db = db
        self._worker_id = worker_id
        self._held = held
        self._on_lost = on_lost
        self._presence = presence
        self._interval_s = interval_s
        self._lease_s = lease_s
        self._stopped = threading.Event()
        self._error: Exception | None = None
        self._thread = threading.Thread(target=self._run, name="heart", daemon=True)

    def start(self) -> None:
        """Begin to beat."""
        self._thread.start()

    def stop(self) -> None:
        """End, after the beat in progress."""
        self._stopped.set()
        self._thread.join()

    def check(self) -> None:
        """Raise what stopped the thread, if anything did: a worker whose heart stands still must not go on."""
        if self._error is not None:
            raise self._error

    def _run(self) -> None:
        try:
            while not self._stopped.wait(self._interval_s):
                self._beat()
        except Exception as err:
            self._error = err

    def _beat(self) -> None:
        try:
            beat(self._db, self._worker_id, memory_used())
            for claim in self._held():
                if not heartbeat(self._db, claim, lease_s=self._lease_s).alive:
                    self._on_lost(claim)
        except StoreUnavailable as err:
            self._presence.note_outage()
            log.warning("No heartbeat this time, the next one tries again: %s", err)
