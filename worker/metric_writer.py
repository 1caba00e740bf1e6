"""Sending metrics to the store from a thread, in batches, so that a training rarely waits for the database."""

from __future__ import annotations

import logging
import threading
import time

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.errors import StoreUnavailable
from backend.store.metrics import MetricPoint, append_metrics
from backend.store.progress import Progress
from worker.patience import insist

FLUSH_S = 0.5
"""Between two batches [s]."""
STAMP_S = 10.0
"""A training that goes on but logs nothing says so to the store this often [s]."""

log = logging.getLogger(__name__)


class MetricWriter:
    """Queue points, and write them in order; points stay queued while the store cannot be used."""

    def __init__(self, db: Database, claim: Claim, interval_s: float = FLUSH_S, stamp_s: float = STAMP_S) -> None:
        self._db = db
        self._claim = claim
        self._interval_s = interval_s
        self._stamp_s = stamp_s
        self._queue_lock = threading.Lock()
        self._write_lock = threading.Lock()
        self._points: list[MetricPoint] = []
        self._progress: Progress | None = None
        self._lives = False
        self._stamp_at = time.monotonic() + stamp_s
        self._closing = threading.Event()
        self._error: Exception | None = None
        self._thread = threading.Thread(target=self._run, name="metric-writer", daemon=True)
        self._thread.start()

    def put(self, point: MetricPoint, progress: Progress) -> None:
        """Queue a point and the progress that goes with it.

        Raises:
            StaleFence: the run was given to another worker.
        """
        self.check()
        with self._queue_lock:
            self._points.append(point)
            self._progress = progress

    def check(self) -> None:
        """Note that the training goes on, and raise what stopped the thread, if anything did.

        Raises:
            StaleFence: the run was given to another worker.
        """
        self._lives = True
        if self._error is not None:
            raise self._error

    def flush(self) -> None:
        """Write everything that is queued, however long the store cannot be used.

        Raises:
            StaleFence: the run was given to another worker.
        """
        self.check()
        insist(self._flush, self._interval_s)

    def close(self) -> None:
        """Write what is left and end the thread.

        Raises:
            StaleFence: the run was given to another worker.
        """
        self._closing.set()
        self._thread.join()
        self.flush()

    def _run(self) -> None:
        try:
            while not self._closing.wait(self._interval_s):
                self._try_flush()
        except Exception as err:
            self._error = err

    def _try_flush(self) -> None:
        try:
            self._flush()
            if self._lives and time.monotonic() >= self._stamp_at:
                self._write([])
        except StoreUnavailable as err:
            log.warning("Metrics wait for the store: %s", err)

    def _flush(self) -> None:
        with self._write_lock:
            with self._queue_lock:
                points, progress = list(self._points), self._progress
            if points:
                self._write(points, progress)
                with self._queue_lock:
                    del self._points[: len(points)]

    def _write(self, points: list[MetricPoint], progress: Progress | None = None) -> None:
        """Store points and how far the training is, or only that it goes on if there are neither."""
        self._lives = False
        self._stamp_at = time.monotonic() + self._stamp_s
        append_metrics(self._db, self._claim, points, progress)
