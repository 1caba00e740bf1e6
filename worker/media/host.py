"""The host of media jobs: takes what is to be drawn from the store and hands it to a process that draws."""

from __future__ import annotations

import logging
import time
from dataclasses import dataclass
from glob import escape
from pathlib import Path

from backend.store.database import Database
from backend.store.errors import FilesUnavailable
from backend.store.files import FileRow, find_file
from backend.store.media_jobs import (
    NO_ATTEMPT,
    MadeFile,
    MediaJob,
    claim_media,
    fail_media,
    finish_media,
    release_media,
    renew_media,
)
from backend.store.settings import Settings
from backend.store.storage import FileStorage
from backend.store.thumbnails import THUMBNAIL_SOURCE, plan_thumbnail
from sldr_core.errors import SldrError
from worker.media.drawing_process import DrawingProcess, Target
from worker.media.orders import Answer, Drawn, DrawOrder, NotDrawn
from worker.media.process import serve_orders
from worker.sentences import unreadable

LOOK_S = 0.5
"""Time between two looks for orders [s]."""
PLAN_S = 5.0
"""Time between two looks for runs without a thumbnail [s]."""
RENEWAL_S = 15.0
"""Time between two signs of life of a job [s]."""
OVERDUE_S = 600.0
"""A job that takes longer has got stuck [s]."""
IDLE_S = 30.0
"""The drawing process ends after this long without an order: it holds some hundred MB [s]."""

log = logging.getLogger("sldr.media")


@dataclass
class _Drawing:
    """Follow the job at hand."""

    job: MediaJob
    order: DrawOrder
    begun: float
    """When it was begun [s, monotonic]."""
    renewed: float
    """When its last sign of life was given [s, monotonic]."""
    answer: Answer | None = None
    """What came of it, until the store knows."""


class MediaHost:
    """Draw one job after the other; `tick` does one round and never waits for a picture."""

    def __init__(self, database: Database, settings: Settings, target: Target = serve_orders) -> None:
        self._database = database
        self._settings = settings
        self._storage = FileStorage(settings)
        self._process = DrawingProcess(target)
        self._drawing: _Drawing | None = None
        self._look_at = self._plan_at = 0.0
        self._idle_since = time.monotonic()
        self._cannot_draw = False

    @property
    def is_idle(self) -> bool:
        """Whether nothing is being drawn."""
        return self._drawing is None

    def tick(self) -> None:
        """Hear the drawing process, or look for the next order.

        Raises:
            StoreUnavailable: the store cannot be used just now.
        """
        now = time.monotonic()
        if self._drawing is not None:
            self._follow(self._drawing, now)
        elif now >= self._look_at:
            self._look_at = now + LOOK_S
            job = self._next_job(now)
            if job is not None:
                self._begin(job, now)
            elif now - self._idle_since > IDLE_S:
                self._process.end()

    def close(self) -> None:
        """End the drawing process, and put back what it was at.

        Raises:
            StoreUnavailable: the store cannot be used just now; the job's lease will run out.
        """
        drawing, self._drawing = self._drawing, None
        self._process.end()
        if drawing is not None:
            release_media(self._database, drawing.job)

    def _next_job(self, now: float) -> MediaJob | None:
        job = claim_media(self._database)
        if job is not None or self._cannot_draw or now < self._plan_at:
            return job
        if plan_thumbnail(self._database) is not None:
            return claim_media(self._database)
        self._plan_at = now + PLAN_S
        return None

    def _begin(self, job: MediaJob, now: float) -> None:
        try:
            order = self._order(job)
        except FilesUnavailable:
            release_media(self._database, job)
            raise
        except SldrError as err:
            fail_media(self._database, job, str(err))
            return
        except OSError as err:
            fail_media(self._database, job, unreadable(err))
            return
        _sweep(order.target)
        self._drawing = _Drawing(job, order, begun=now, renewed=now)
        self._process.send(order)

    def _order(self, job: MediaJob) -> DrawOrder:
        arguments = job.arguments
        row = find_file(self._database, job.run_id, arguments["file"])
        return DrawOrder(
            kind=job.kind,
            source=self._find_source(row),
            target=self._settings.run_directory(job.run_id) / job.file_name,
            width=arguments["width"],
            height=arguments["height"],
            number=arguments["number"],
        )

    def _find_source(self, row: FileRow) -> Path:
        # The newest policy is replaced again and again: whichever is there is the one to draw.
        here = self._storage.find_here(row) if row.name == THUMBNAIL_SOURCE else None
        return here or self._storage.bring(row)

    def _follow(self, drawing: _Drawing, now: float) -> None:
        drawing.answer = drawing.answer or self._process.poll()
        if drawing.answer is not None:
            self._end(drawing, drawing.answer)
        elif now - drawing.begun > OVERDUE_S:
            self._process.end()
            drawing.answer = NotDrawn(f"It was not drawn within {OVERDUE_S / 60:.0f} minutes.")
        elif now - drawing.renewed > RENEWAL_S:
            drawing.renewed = now
            renew_media(self._database, drawing.job)

    def _end(self, drawing: _Drawing, answer: Answer) -> None:
        match answer:
            case Drawn(size, sha256):
                self._cannot_draw = False
                self._keep(drawing, size, sha256)
            case NotDrawn(reason, is_machine):
                self._cannot_draw = is_machine
                log.warning("%s of run %s: %s", drawing.job.file_name, drawing.job.run_id, reason)
                fail_media(self._database, drawing.job, reason)
                # A renderer that has failed once is not trusted again.
                self._process.end()
                _sweep(drawing.order.target)
        self._drawing = None
        self._idle_since, self._look_at = time.monotonic(), 0.0

    def _keep(self, drawing: _Drawing, size: int, sha256: str) -> None:
        job, target = drawing.job, drawing.order.target
        path = self._storage.keep(job.run_id, NO_ATTEMPT, target, sha256)
        left = finish_media(self._database, job, MadeFile(path, size, sha256))
        if left is not None:
            self._storage.forget(left)


def _sweep(target: Path) -> None:
    """Remove what drawing processes that were killed have left of a file; who holds its job draws it alone."""
    for left in target.parent.glob(f".{escape(target.name)}.*.tmp"):
        left.unlink(missing_ok=True)
