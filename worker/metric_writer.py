"""Sending metrics to the store from a thread, in batches, so that a training never waits for the database."""

from __future__ import annotations

import logging
import threading

from backend.store.claims import Claim
from backend.store.database import Database
from backend.store.errors import StoreUnavailable
from backend.store.metrics import MetricPoint, append_metrics
from backend.store.progress import Progress, report_progress
from worker.patience import when_possible

FLUSH_S = 0.5
"""Between two batches [s]."""

log = logging.getLogger(__name__)


class MetricWriter:
    """Queue points, and write them in order; points stay queued while the store cannot be used."""

    def __init__(self, db: Database, claim: Claim, interval_s: float = FLUSH_S) -> None:
        self._db = db
        self._claim = claim
        self._interval_s = interval_s
        self._lock = threading.Lock()
        self._points: list[MetricPoint] = []
        self._progress: Progress | None = None
        self._closing = threading.Event()
        self._error: Exception | None = None
        self._thread = threading.Thread(target=self._run, name="metric-writer", daemon=True)
        self._thread.start()

    def put(self, point: MetricPoint, progress: Progress) -> None:
        """Queue a point and the progress that goes with it."""
        self.check()
        with self._lock:
            self._points.append(point)
            self._progress = progress

    def check(self) -> None:
        """Raise what stopped the thread, if anything did.

        Raises:
            StaleFence: the run was given to another worker.
        """
        if self._error is not None:
            raise self._error

    def close(self) -> None:
        """Write what is left and end the thread.

        Raises:
            StaleFence: the run was given to another worker.
            StoreUnavailable: the store could not be used for minutes.
        """
        self._closing.set()
        self._thread.join()
        self.check()
        when_possible(self._flush)

    def _run(self) -> None:
        try:
            while not self._closing.wait(self._interval_s):
                self._try_flush()
        except Exception as err:
            self._error = err

    def _try_flush(self) -> None:
        try:
            self._flush()
        except StoreUnavailable as err:
            log.warning("Metrics wait for the store: %s", err)

    def _flush(self) -> None:
        with self._lock:
            points, progress = list(self._points), self._progress
        if points:
            append_metrics(self._db, self._claim, points)
            with self._lock:
                del self._points[: len(points)]
        if progress is not None:
            report_progress(self._db, self._claim, progress)
            with self._lock:
                self._progress = None if self._progress is progress else self._progress
